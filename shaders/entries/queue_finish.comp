#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
// What the paths found, as a picture; and the balance of the queues, summed by the first workgroup.
#include "path/wavefront.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

void main() {
    if (gl_WorkGroupID.xy == uvec2(0u)) atomicAdd(counters.queue_balance, queue_counts[gl_LocalInvocationIndex]);
    uvec2 pixel = pixelOfThread();
    if (!insideSlice(pixel) || !isSampled(pixel, frame.view.size.x, push.sample_index)) return;
    Hit hit = gbufferHit(ivec2(pixel));
    bool opaque = isOpaqueInPicture(hit, gbufferWo(hit, ivec2(pixel), push.sample_index));
    if (!storeSample(pixel, unpackRadiance(pathOfThread()), opaque)) beginSignals(pixel);
}
