#version 460
#extension GL_GOOGLE_include_directive : require
// What tells surfaces apart, from the sums over samples.
#include "pure/tiles.glsl"
#include "shared/bindings.h"
#include "shared/signals.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Push { FilterPush push; };
layout(rgba32f, binding = kBindingSignalSums) uniform readonly image2D signal_sums;
layout(rgba32f, binding = kBindingFilterGuide) uniform writeonly image2D filter_guide;

// 1 / depth, or depth where the camera is orthographic; 0: no surface.
float placeAt(ivec2 pixel) {
    if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, ivec2(push.size)))) return 0.0;
    float hits = imageLoad(signal_sums, tilePlace(imageSize(signal_sums), push.size, kSumFirstSpread, uvec2(pixel))).a;
    float depth = imageLoad(signal_sums, tilePlace(imageSize(signal_sums), push.size, kSumFirstPlace, uvec2(pixel))).w;
    if (hits <= 0.0 || depth <= 0.0) return 0.0;
    return push.orthographic != 0u ? depth / hits : hits / depth;
}

// Of the two sides the one that changes less: the other may be another surface.
float slopeBetween(float before, float here, float behind) {
    if (before <= 0.0) return behind > 0.0 ? behind - here : 0.0;
    if (behind <= 0.0) return here - before;
    return abs(here - before) < abs(behind - here) ? here - before : behind - here;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(push.size)))) return;
    float place = placeAt(pixel);
    vec3 normal = imageLoad(signal_sums, tilePlace(imageSize(signal_sums), push.size, kSumFirstPlace, uvec2(pixel))).xyz;
    float n2 = dot(normal, normal);
    vec2 slope = vec2(slopeBetween(placeAt(pixel - ivec2(1, 0)), place, placeAt(pixel + ivec2(1, 0))),
                      slopeBetween(placeAt(pixel - ivec2(0, 1)), place, placeAt(pixel + ivec2(0, 1))));
    ivec2 size = imageSize(filter_guide);
    imageStore(filter_guide, tilePlace(size, push.size, kGuidePlace, uvec2(pixel)), vec4(n2 > 0.0 ? normal * inversesqrt(n2) : vec3(0.0), place));
    imageStore(filter_guide, tilePlace(size, push.size, kGuideSlope, uvec2(pixel)), vec4(slope, 0.0, 0.0));
}
