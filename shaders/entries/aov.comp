#version 460
#extension GL_GOOGLE_include_directive : require
// Extra layers from the primary hits: sums over the samples that hit a surface, which the host divides by their number, and the motion of this frame.
#include "camera/gbuffer.glsl"
#include "bound/surface.glsl"
#include "shared/bindings.h"
#include "shared/frame.h"
#include "shared/index.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Push { SamplePush push; };
layout(rgba32f, binding = kBindingAovAlbedo) uniform image2D aov_albedo;  // RGB; A: number of hits
layout(rgba32f, binding = kBindingAovNormal) uniform image2D aov_normal;  // XYZ; W: depth
layout(rgba32f, binding = kBindingAovMotion) uniform writeonly image2D aov_motion;  // XY

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(aov_albedo)))) return;
    bvec4 fresh = bvec4(push.count_before == 0u);  // selected, not branched on: see accumulate.comp
    vec4 albedo = mix(imageLoad(aov_albedo, pixel), vec4(0.0), fresh);
    vec4 normal = mix(imageLoad(aov_normal, pixel), vec4(0.0), fresh);
    vec2 motion = vec2(0.0);  // not summed up: a camera that rests again moves nothing
    Hit hit = gbufferHit(pixel);
    if (hit.instance != kNoIndex) {
        Surface s = surfaceAt(hit, gbufferWo(hit, pixel, push.sample_index));
        albedo += vec4(s.base_color, 1.0);
        normal += vec4(s.frame.normal, -dot(frame.view.back, s.position - frame.view.eye));
        motion = pixelFromWorld(frame.view, s.position) - pixelFromWorld(frame.previous_view, s.position);
    }
    imageStore(aov_albedo, pixel, albedo);
    imageStore(aov_normal, pixel, normal);
    imageStore(aov_motion, pixel, vec4(motion, 0.0, 0.0));
}
