#version 460
#extension GL_GOOGLE_include_directive : require
// One sample per pixel: from the G-buffer's hit along a whole path.
#include "bound/gbuffer.glsl"
#include "bound/path.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Push { SamplePush push; };
layout(rgba32f, binding = 21) uniform writeonly image2D radiance_image;
layout(std430, binding = 16) buffer Counters { CounterRecord counters; };

shared uint s_bounce_rays;
shared uint s_shadow_rays;

bool finite(vec3 c) { return all(lessThan(floatBitsToUint(c) & 0x7f800000u, uvec3(0x7f800000u))); }

void main() {
    if (gl_LocalInvocationIndex == 0u) {
        s_bounce_rays = 0u;
        s_shadow_rays = 0u;
    }
    barrier();
    PathCounts counts = PathCounts(0u, 0u);
    uvec2 pixel = gl_GlobalInvocationID.xy + uvec2(0u, push.first_row);
    if (pixel.x < frame.view.size.x && gl_GlobalInvocationID.y < push.row_count && pixel.y < frame.view.size.y) {
        g_address = SampleAddress(pixel, push.sample_index, frame.seed);
        g_rays_before = 1u;  // the rasteriser's was the first
        Hit hit = gbufferHit(ivec2(pixel));
        vec3 radiance = pathRadiance(hit, gbufferWo(hit, ivec2(pixel), push.sample_index), counts);
        // A sample that is no number counts as black and is reported, never hidden.
        if (!finite(radiance)) {
            radiance = vec3(0.0);
            atomicAdd(counters.nonfinite_samples, 1u);
        }
        if (bvh_walk_cut) atomicAdd(counters.cut_walks, 1u);
        bool covered = hit.instance != kNoIndex || frame.has_sky != 0u;
        imageStore(radiance_image, ivec2(pixel), vec4(radiance, covered ? 1.0 : 0.0));
    }
    atomicAdd(s_bounce_rays, counts.bounce_rays);
    atomicAdd(s_shadow_rays, counts.shadow_rays);
    barrier();
    if (gl_LocalInvocationIndex == 0u) {
        atomicAdd(counters.bounce_rays, s_bounce_rays);
        atomicAdd(counters.shadow_rays, s_shadow_rays);
    }
}
