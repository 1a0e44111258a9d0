#version 460
#extension GL_GOOGLE_include_directive : require
// One sample per pixel, by one kernel: from the G-buffer's hit along a whole path.
#include "path/adaptive.glsl"
#include "camera/gbuffer.glsl"
#include "path/watch.glsl"
#include "shared/constants.h"
#include "shared/frame.h"
#include "shared/index.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = kConstantPathsPerThread) const uint kPathsPerThread = 1u;
layout(push_constant) uniform Push { SamplePush push; };

shared uint s_bounce_rays;
shared uint s_shadow_rays;

void main() {
    if (gl_LocalInvocationIndex == 0u) {
        s_bounce_rays = 0u;
        s_shadow_rays = 0u;
    }
    barrier();
    PathCounts counts = kNothingCounted;
    // The wavefront's kernels waste fewer lanes, and take longer to compile; engine/run/queue_choice.cpp says when they pay.
    // A thread follows a column of paths, the next one as soon as one ends: drivers that run lanes in lockstep would otherwise idle wherever the
    // paths of a group are of different lengths.
    uvec2 pixel = uvec2(gl_GlobalInvocationID.x, push.first_row + gl_WorkGroupID.y * gl_WorkGroupSize.y * kPathsPerThread + gl_LocalInvocationID.y);
    uint rows_end = pixel.x < frame.view.size.x ? min(push.first_row + push.row_count, frame.view.size.y) : 0u;
    uint left = kPathsPerThread;
    bool covered = false;
    bool begun = false;
    Path p;
    while (true) {
        if (begun && p.alive && p.hit.instance == kNoIndex) endInSky(p);
        // On to the next path, where this one has ended.
        if (!begun || !p.alive) {
            if (begun) {
                if (!storeSample(pixel, p.radiance, covered)) beginSignals(pixel);
                pixel.y += gl_WorkGroupSize.y;
            }
            if (left == 0u || pixel.y >= rows_end) break;
            --left;
            begun = isSampled(pixel, frame.view.size.x, push.sample_index);
            if (!begun) {
                pixel.y += gl_WorkGroupSize.y;
                continue;
            }
            beginSignals(pixel);
            Hit hit = gbufferHit(ivec2(pixel));
            p = beginPath(sampleAddress(pixel, push.sample_index), hit, gbufferWo(hit, ivec2(pixel), push.sample_index));
            covered = isOpaqueInPicture(hit, p.wo);
        }
        if (p.hit.instance != kNoIndex) extendAndTrace(p, counts);
    }
    storeCounts(counts);
    atomicAdd(s_bounce_rays, counts.bounce_rays);
    atomicAdd(s_shadow_rays, counts.shadow_rays);
    barrier();
    if (gl_LocalInvocationIndex == 0u) {
        atomicAdd(counters.bounce_rays, s_bounce_rays);
        atomicAdd(counters.shadow_rays, s_shadow_rays);
    }
}
