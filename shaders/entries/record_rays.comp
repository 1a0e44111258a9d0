#version 460
#extension GL_GOOGLE_include_directive : require
// Follows one path a pixel as path.comp does and writes down the rays that it traces, for measuring them alone.
#include "bound/gbuffer.glsl"
#include "bound/path.glsl"
#include "shared/bindings.h"
#include "shared/dimensions.h"
#include "shared/frame.h"
#include "shared/index.h"
#include "shared/ray_records.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Push { SamplePush push; };
// A list a binding, because one buffer for all would be larger than devices must allow.
layout(std430, binding = kFirstFreeBinding) writeonly buffer PrimaryRays { RayRecord primary_rays[]; };
layout(std430, binding = kFirstFreeBinding + 1u) writeonly buffer FirstShadowRays { RayRecord first_shadow_rays[]; };
layout(std430, binding = kFirstFreeBinding + 2u) writeonly buffer FirstBounceRays { RayRecord first_bounce_rays[]; };
layout(std430, binding = kFirstFreeBinding + 3u) writeonly buffer SecondShadowRays { RayRecord second_shadow_rays[]; };
layout(std430, binding = kFirstFreeBinding + 4u) writeonly buffer SecondBounceRays { RayRecord second_bounce_rays[]; };
layout(std430, binding = kFirstFreeBinding + 5u) writeonly buffer GlossyRays { RayRecord glossy_rays[]; };

const RayRecord kNoRay = RayRecord(vec3(0.0), 0.0, vec3(0.0, 0.0, 1.0), -1.0);

RayRecord g_shadow[kRecordedBounces];
RayRecord g_bounce[kRecordedBounces];
uint g_bounces;  // scattered so far

void onRay(vec3 origin, vec3 direction, float t_max, bool any_hit) {
    RayRecord ray = RayRecord(origin, 0.0, direction, t_max);
    uint vertex = min(g_bounces, kRecordedBounces - 1u);
    if (any_hit) {
        g_shadow[vertex] = ray;
    } else {
        g_bounce[vertex] = ray;
        ++g_bounces;
    }
}

void onLight(uint order, vec3 kept, vec3 lost) {}
void onRays(uint order, uint rays) {}

// The ray that the rasteriser stands for.
RayRecord primaryRay(vec2 pixel_position) {
    vec3 direction = -directionToCamera(frame.view, pixel_position);
    vec3 origin = frame.view.eye;
    if (frame.view.orthographic != 0u) {
        vec2 ndc = 2.0 * pixel_position / vec2(frame.view.size) - 1.0;
        origin += ndc.x * frame.view.scale_x * frame.view.right - ndc.y * frame.view.scale_y * frame.view.up;
    }
    return RayRecord(origin, 0.0, direction, uintBitsToFloat(0x7f800000u));
}

RayRecord glossyRay(Hit hit, vec3 wo) {
    if (hit.instance == kNoIndex) return kNoRay;
    Surface s = surfaceAt(hit, wo);
    vec3 wo_local = localFromWorld(s.frame, wo);
    vec3 h = sampleGgxVisibleNormal(wo_local, kRecordedRoughness * kRecordedRoughness, sample4(g_address, kDimensionBounce + kDimensionScatter).yz);
    vec3 wi = worldFromLocal(s.frame, 2.0 * dot(wo_local, h) * h - wo_local);
    if (dot(wi, s.face_normal) <= 0.0 || dot(wi, s.frame.normal) <= 0.0) return kNoRay;
    return RayRecord(offsetOrigin(s, wi), 0.0, wi, uintBitsToFloat(0x7f800000u));
}

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy + uvec2(0u, push.first_row);
    // Lists are in the order of the invocations, tile by tile, so that what is traced together lies together.
    uvec2 tile = pixel / gl_WorkGroupSize.xy;
    uint tiles_across = (frame.view.size.x + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;
    uint at = (tile.y * tiles_across + tile.x) * gl_WorkGroupSize.x * gl_WorkGroupSize.y + gl_LocalInvocationIndex;
    RayRecord primary = kNoRay;
    RayRecord glossy = kNoRay;
    for (uint i = 0u; i < kRecordedBounces; ++i) {
        g_shadow[i] = kNoRay;
        g_bounce[i] = kNoRay;
    }
    g_bounces = 0u;
    if (pixel.x < frame.view.size.x && pixel.y < frame.view.size.y) {
        g_address = SampleAddress(pixel, push.sample_index, frame.seed);
        g_rays_before = 1u;
        Hit hit = gbufferHit(ivec2(pixel));
        primary = primaryRay(vec2(pixel) + cameraJitter(push.sample_index, frame.seed));
        vec3 wo = gbufferWo(hit, ivec2(pixel), push.sample_index);
        PathCounts counts = PathCounts(0u, 0u);
        pathRadiance(hit, wo, counts);
        glossy = glossyRay(hit, wo);
    }
    primary_rays[at] = primary;
    first_shadow_rays[at] = g_shadow[0];
    first_bounce_rays[at] = g_bounce[0];
    second_shadow_rays[at] = g_shadow[1];
    second_bounce_rays[at] = g_bounce[1];
    glossy_rays[at] = glossy;
}
