#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
// Where the paths go on: those that hit something are queued for their next vertex, the others end in the sky.
#include "bound/queues.glsl"

layout(local_size_x = 64) in;

void main() {
    bool hits = false;
    uint path = 0u;
    if (gl_GlobalInvocationID.x < queueCount(push.bounce, kCountRays)) {
        int at = int(kRayTexels * gl_GlobalInvocationID.x);
        uvec4 o = texelFetch(queue_ray_texels, at), d = texelFetch(queue_ray_texels, at + 1);
        path = o.w;
        addressPath(path, rayCountOf(path) - 1u);
        Hit hit = traceNearest(uintBitsToFloat(o.xyz), uintBitsToFloat(d.xyz));
        hits = hit.instance != kNoIndex;
        if (hits) {
            storeHit(path, hit);
        } else if (kEnvironment) {
            Path p = loadPath(path);
            endInSky(p);
            addRadiance(path, p.radiance);
        }
        countCutWalk();
    }
    uint place = appendTo(push.bounce + 1u, kCountHits, hits);
    if (hits) queue_hits[place] = path;
}
