#version 460
#extension GL_GOOGLE_include_directive : require
// Follows one path a pixel as path.comp does and writes down the rays that it traces, for measuring them alone.
#include "camera/gbuffer.glsl"
#include "path/unwatched.glsl"
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

RayRecord recordOf(RayQuery ray) { return RayRecord(ray.origin, ray.t_min, ray.direction, ray.t_max); }

RayRecord glossyRay(SampleAddress address, Hit hit, vec3 wo) {
    if (hit.instance == kNoIndex) return kNoRay;
    Surface s = surfaceAt(hit, wo);
    vec3 wo_local = localFromWorld(s.frame, wo);
    vec3 h = sampleGgxVisibleNormal(wo_local, kRecordedRoughness * kRecordedRoughness, sample4(address, kDimensionBounce + kDimensionScatter).yz);
    vec3 wi = worldFromLocal(s.frame, 2.0 * dot(wo_local, h) * h - wo_local);
    if (dot(wi, s.face_normal) <= 0.0 || dot(wi, s.frame.normal) <= 0.0) return kNoRay;
    return recordOf(pathQuery(offsetOrigin(vertexOn(s), wi), wi));
}

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy + uvec2(0u, push.first_row);
    // Lists are in the order of the invocations, tile by tile, so that what is traced together lies together.
    uvec2 tile = pixel / gl_WorkGroupSize.xy;
    uint tiles_across = (frame.view.size.x + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;
    uint at = (tile.y * tiles_across + tile.x) * gl_WorkGroupSize.x * gl_WorkGroupSize.y + gl_LocalInvocationIndex;
    RayRecord primary = kNoRay;
    RayRecord glossy = kNoRay;
    RayRecord shadow[kRecordedBounces], bounce[kRecordedBounces];
    for (uint i = 0u; i < kRecordedBounces; ++i) {
        shadow[i] = kNoRay;
        bounce[i] = kNoRay;
    }
    if (pixel.x < frame.view.size.x && pixel.y < frame.view.size.y) {
        CameraRay camera_ray = pixelRay(ivec2(pixel), push.sample_index);  // which the rasteriser stands for
        primary = recordOf(pathQuery(camera_ray.origin, camera_ray.direction));
        Hit hit = gbufferHit(ivec2(pixel));
        vec3 wo = gbufferWo(hit, ivec2(pixel), push.sample_index);
        SampleAddress address = SampleAddress(pixel, push.sample_index, frame.seed);
        glossy = glossyRay(address, hit, wo);
        Path p = beginPath(address, hit, wo);
        PathCounts counts = kNothingCounted;
        while (p.alive && p.hit.instance != kNoIndex) {
            uint vertex = p.bounce;
            ShadowRay to_light;
            SceneRay onward;
            extendPath(p, counts, to_light, onward);
            if (to_light.wanted) shadow[vertex] = recordOf(to_light.ray.query);
            if (!p.alive) break;
            bounce[vertex] = recordOf(onward.query);
            trace(onward);
            p.hit = onward.hit;
        }
    }
    primary_rays[at] = primary;
    first_shadow_rays[at] = shadow[0];
    first_bounce_rays[at] = bounce[0];
    second_shadow_rays[at] = shadow[1];
    second_bounce_rays[at] = bounce[1];
    glossy_rays[at] = glossy;
}
