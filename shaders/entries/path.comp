#version 460
#extension GL_GOOGLE_include_directive : require
// One sample per pixel: from the G-buffer's hit along a whole path.
#include "bound/gbuffer.glsl"
#include "bound/path.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 72) const uint kPathsPerThread = 1u;  // kConstantPathsPerThread
layout(push_constant) uniform Push { SamplePush push; };
layout(rgba32f, binding = 21) uniform writeonly image2D radiance_image;
layout(std430, binding = 16) buffer Counters { CounterRecord counters; };

shared uint s_bounce_rays;
shared uint s_shadow_rays;

void onRay(vec3 origin, vec3 direction, float t_max, bool any_hit) {}

bool finite(vec3 c) { return all(lessThan(floatBitsToUint(c) & 0x7f800000u, uvec3(0x7f800000u))); }

// A sample that is no number counts as black and is reported, never hidden.
void storePath(uvec2 pixel, vec3 radiance, bool covered) {
    if (!finite(radiance)) {
        radiance = vec3(0.0);
        atomicAdd(counters.nonfinite_samples, 1u);
    }
    if (bvh_walk_cut) atomicAdd(counters.cut_walks, 1u);
    bvh_walk_cut = false;
    imageStore(radiance_image, ivec2(pixel), vec4(radiance, covered ? 1.0 : 0.0));
}

void main() {
    if (gl_LocalInvocationIndex == 0u) {
        s_bounce_rays = 0u;
        s_shadow_rays = 0u;
    }
    barrier();
    PathCounts counts = PathCounts(0u, 0u);
    // A thread follows a column of paths, the next one as soon as one ends: drivers that run lanes in lockstep would otherwise idle wherever the
    // paths of a group are of different lengths.
    uvec2 pixel = uvec2(gl_GlobalInvocationID.x, push.first_row + gl_WorkGroupID.y * gl_WorkGroupSize.y * kPathsPerThread + gl_LocalInvocationID.y);
    uint rows_end = pixel.x < frame.view.size.x ? min(push.first_row + push.row_count, frame.view.size.y) : 0u;
    uint left = kPathsPerThread;
    bool covered = false;
    Path p = beginPath(kNoHit, vec3(0.0));
    bool begun = false;
    while (true) {
        if (begun && p.hit.instance == kNoIndex && p.alive) endInSky(p);
        if (!begun || !p.alive) {
            if (begun) {
                storePath(pixel, p.radiance, covered);
                pixel.y += gl_WorkGroupSize.y;
            }
            if (left == 0u || pixel.y >= rows_end) break;
            --left;
            begun = true;
            g_address = SampleAddress(pixel, push.sample_index, frame.seed);
            g_rays_before = 1u;  // the rasteriser's was the first
            Hit hit = gbufferHit(ivec2(pixel));
            p = beginPath(hit, gbufferWo(hit, ivec2(pixel), push.sample_index));
            covered = hit.instance != kNoIndex || frame.has_sky != 0u;
        }
        if (p.hit.instance != kNoIndex) extendPath(p, counts);
    }
    atomicAdd(s_bounce_rays, counts.bounce_rays);
    atomicAdd(s_shadow_rays, counts.shadow_rays);
    barrier();
    if (gl_LocalInvocationIndex == 0u) {
        atomicAdd(counters.bounce_rays, s_bounce_rays);
        atomicAdd(counters.shadow_rays, s_shadow_rays);
    }
}
