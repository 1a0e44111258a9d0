#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
// Light that is not blocked is added to the path that asked for it.
#include "bound/queues.glsl"

layout(local_size_x = 64) in;

void main() {
    if (gl_GlobalInvocationID.x >= queueCount(push.bounce, kCountShadows)) return;
    int at = int(kShadowTexels * gl_GlobalInvocationID.x);
    uvec4 o = texelFetch(queue_shadow_texels, at), d = texelFetch(queue_shadow_texels, at + 1), c = texelFetch(queue_shadow_texels, at + 2);
    uint path = d.w;
    addressPath(path, c.w);
    if (!occluded(uintBitsToFloat(o.xyz), uintBitsToFloat(d.xyz), uintBitsToFloat(o.w))) addRadiance(path, foundLight(push.bounce + 1u, uintBitsToFloat(c.xyz)));
    countCutWalk();
}
