#version 460
#extension GL_GOOGLE_include_directive : require
// The picture: of each kind of light the mean of all samples, moved towards what the filter made of it as far as the noise that goes outweighs the bias that
// comes. Where the filter is biased its share falls as the noise does, so the picture converges to the truth; and what is left of both is its squared error.
#include "filter/halves.glsl"

layout(constant_id = kConstantSpatial) const bool kSpatial = true;
layout(rgba32f, binding = kBindingMeanHigh) uniform readonly image2D mean_high;
layout(rgba32f, binding = kBindingFilterFrom) uniform readonly image2D filter_from;
// Squared biases, far and near; without the spatial filter variances of a sample.
layout(rgba32f, binding = kBindingSmoothFrom) uniform readonly image2D smooth_from;
layout(rgba32f, binding = kBindingFiltered) uniform writeonly image2D filtered;
layout(rgba32f, binding = kBindingFilteredError) uniform writeonly image2D filtered_error;

// What the filter makes of a kind of light.
struct Part {
    vec3 move;           // from the mean of all samples
    float error;         // squared, mean of the channels
    float squared_bias;  // of that
};

Part partOf(uint kind, vec3 x, Halves h, float of_sample, vec4 biases, ivec2 pixel) {
    float variance = of_sample / countOf(h);
    if (!kSpatial) return Part(vec3(0.0), variance, 0.0);
    bool split_ = isSplit(h);
    h = whole(h);
    uint tile = kFilterSpread + kHalves * kind;
    vec4 f_a = tileTexel(filter_from, tile, pixel), f_b = tileTexel(filter_from, tile + 1u, pixel);
    // That near by stands out where it is above twice its noise: of the product of two halves' means, over so many pixels.
    float noise = 2.0 * of_sample * inversesqrt(h.n_a * h.n_b * kNarrowPixels);
    float bias = max(max(biases[kind], biases[2u + kind] - noise), 0.0);
    float share = variance > 0.0 ? variance / (variance + bias) : 0.0;
    float left = split_ ? (h.n_a * h.n_a * f_a.w + h.n_b * h.n_b * f_b.w) / (countOf(h) * countOf(h)) : f_a.w;
    float kept = 1.0 - share;
    return Part(share * (ofBoth(f_a.rgb, f_b.rgb, h) - x), kept * kept * variance + share * share * (left + bias), share * share * bias);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!isInside(pixel)) return;
    vec4 mean = imageLoad(mean_high, pixel);
    // Light that comes straight to the camera is never filtered.
    vec3 error = vec3(0.0);
    if (push.count_a > 0.0 && push.count_b > 0.0) {
        vec3 seen = tileTexel(signal_sums, kSumSeen, pixel).rgb / push.count_a - tileTexel(signal_sums, kSumSeen + 1u, pixel).rgb / push.count_b;
        float samples = push.count_a + push.count_b;
        error = seen * seen * (push.count_a * push.count_b) / (samples * samples);
    }
    float squared_bias = 0.0;
    if (tileTexel(filter_guide, kGuidePlace, pixel).w > 0.0) {
        vec4 smooth_ = imageLoad(smooth_from, pixel);
        vec2 variances = kSpatial ? tileTexel(filter_from, kFilterCentre, pixel).zw : smooth_.xy;
        for (uint kind = 0u; kind < kKinds; ++kind) {
            vec3 d = demodulation(kind, pixel);
            Halves h = halvesOf(kind, d, pixel);
            vec3 x = ofBoth(h.a, h.b, h);
            Part part = partOf(kind, x, h, variances[kind], smooth_, pixel);
            if (kReprojects) mean.rgb += d * moveByPrior(kind, d, h, pixel);
            mean.rgb += d * part.move;
            squared_bias += meanSquare(d) * part.squared_bias;
            error += d * d * part.error;
        }
    }
    imageStore(filtered, pixel, vec4(max(mean.rgb, vec3(0.0)), mean.a));
    imageStore(filtered_error, pixel, vec4(error, squared_bias));
}
