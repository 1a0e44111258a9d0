#version 460
#extension GL_GOOGLE_include_directive : require
// A level of the filter: 25 taps, `stride` pixels apart. A tap counts as far as it shows the same surface and as its light differs by no more than noise, of
// which the other half of the samples is asked.
#include "filter/filter.glsl"
#include "shared/constants.h"

layout(rgba32f, binding = kBindingFilterFrom) uniform readonly image2D filter_from;
layout(rgba32f, binding = kBindingFilterTo) uniform writeonly image2D filter_to;
layout(rgba32f, binding = kBindingSmoothFrom) uniform readonly image2D smooth_from;  // variances of a sample

layout(constant_id = kConstantFirstLevel) const bool kFirstLevel = false;

// Both halves of a kind of light, with their variances.
struct Filtered {
    vec4 a;
    vec4 b;
};

Filtered filteredAt(uint kind, ivec2 origin_a, ivec2 origin_b, ivec2 pixel) {
    Filtered h = Filtered(imageLoad(filter_from, origin_a + pixel), imageLoad(filter_from, origin_b + pixel));
    // Before the first level it follows from a sample's, and A is how many there are.
    if (kFirstLevel) {
        float of_sample = imageLoad(smooth_from, pixel)[kind];
        h.a.w = of_sample / h.a.w;
        h.b.w = of_sample / h.b.w;
    }
    return h;
}

// How far two means differ beyond noise, of which their squared difference is as large as their variances on average.
float distanceOfLight(vec4 a, vec4 b) {
    const float kTolerance = 2.5;  // standard deviations at which a tap counts 1/e
    return meanSquare(a.rgb - b.rgb) / (kTolerance * kTolerance * (a.w + b.w) + 1e-20);
}

void filterKind(uint kind, ivec2 pixel, Guide guide, inout float centre) {
    const float kCentre = 0.375 * 0.375;
    uint tile = kFilterSpread + kHalves * kind;
    ivec2 origin_a = tileOrigin(imageSize(filter_from), push.size, tile), origin_b = tileOrigin(imageSize(filter_from), push.size, tile + 1u);
    Filtered here = filteredAt(kind, origin_a, origin_b, pixel);
    vec3 sum_a = kCentre * here.a.rgb, sum_b = kCentre * here.b.rgb;
    float variance_a = kCentre * kCentre * here.a.w, variance_b = kCentre * kCentre * here.b.w;
    float weights_a = kCentre, weights_b = kCentre;
    for (int y = -2; y <= 2; ++y) {
        for (int x = -2; x <= 2; ++x) {
            ivec2 offset = ivec2(x, y) * int(push.stride), tap = pixel + offset;
            if (offset == ivec2(0) || !isInside(tap)) continue;
            float surface = distanceFromSurface(guide, tap, offset);
            if (surface > kFarthest) continue;
            Filtered there = filteredAt(kind, origin_a, origin_b, tap);
            float row = rowOfFive(x) * rowOfFive(y);
            float w_a = row * exp(-surface - distanceOfLight(here.b, there.b)), w_b = row * exp(-surface - distanceOfLight(here.a, there.a));
            sum_a += w_a * there.a.rgb;
            sum_b += w_b * there.b.rgb;
            variance_a += w_a * w_a * there.a.w;
            variance_b += w_b * w_b * there.b.w;
            weights_a += w_a;
            weights_b += w_b;
        }
    }
    centre *= kCentre * inversesqrt(weights_a * weights_b);
    imageStore(filter_to, origin_a + pixel, vec4(sum_a / weights_a, variance_a / (weights_a * weights_a)));
    imageStore(filter_to, origin_b + pixel, vec4(sum_b / weights_b, variance_b / (weights_b * weights_b)));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!isInside(pixel)) return;
    Guide guide = guideOf(pixel);
    if (guide.place <= 0.0) return;
    vec4 centre = tileTexel(filter_from, kFilterCentre, pixel);
    if (kFirstLevel) centre.zw = imageLoad(smooth_from, pixel).xy;
    for (uint kind = 0u; kind < kKinds; ++kind) filterKind(kind, pixel, guide, centre[kind]);
    imageStore(filter_to, tilePlace(imageSize(filter_to), push.size, kFilterCentre, uvec2(pixel)), centre);
}
