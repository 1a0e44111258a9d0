#version 460
#extension GL_GOOGLE_include_directive : require
// Traces each pixel's primary ray again and compares with the G-buffer.
#include "camera/gbuffer.glsl"
#include "ray/visibility.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Push { SamplePush push; };
layout(std430, binding = kFirstFreeBinding) buffer OutcomeBlock {
    uint hits;
    uint different;
    uint far_away;
    uint lost;
};

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(gbuffer)))) return;
    Hit seen = gbufferHit(pixel);
    if (seen.instance == kNoIndex) return;
    atomicAdd(hits, 1u);
    vec3 target = hitPosition(seen);
    vec3 away = -directionToCamera(frame.view, target);
    vec3 origin = frame.view.orthographic != 0u ? target - away * frame.view.z_far : frame.view.eye;
    // Surfaces before the near plane are not drawn.
    SceneRay ray = sceneRay(pathQuery(origin + away * frame.view.z_near, away), SampleAddress(uvec2(pixel), push.sample_index, frame.seed), 0u);
    trace(ray);
    Hit traced = ray.hit;
    if (traced.instance == kNoIndex) {
        atomicAdd(lost, 1u);
        return;
    }
    if (traced.instance == seen.instance && traced.primitive == seen.primitive) return;
    atomicAdd(different, 1u);
    if (distance(hitPosition(traced), target) > 1e-2 * distance(target, origin)) atomicAdd(far_away, 1u);
}
