#version 460
#extension GL_GOOGLE_include_directive : require
// The picture: of each kind of light the mean of all samples, moved towards what the filter made of it as far as the noise that goes outweighs the bias that
// comes. Where the filter is biased its share falls as the noise does, so the picture converges to the truth; and what is left of both is its squared error.
#include "filter/halves.glsl"

layout(rgba32f, binding = kBindingMeanHigh) uniform readonly image2D mean_high;
layout(rgba32f, binding = kBindingFilterFrom) uniform readonly image2D filter_from;
layout(rgba32f, binding = kBindingSmoothFrom) uniform readonly image2D smooth_from;  // squared biases, far and near
layout(rgba32f, binding = kBindingFiltered) uniform writeonly image2D filtered;
layout(rgba32f, binding = kBindingFilteredError) uniform writeonly image2D filtered_error;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!isInside(pixel)) return;
    vec4 mean = imageLoad(mean_high, pixel);
    // Light that comes straight to the camera is never filtered.
    vec3 seen = tileTexel(signal_sums, kSumSeen, pixel).rgb / push.count_a - tileTexel(signal_sums, kSumSeen + 1u, pixel).rgb / push.count_b;
    vec3 error = seen * seen * (push.count_a * push.count_b) / (countOfBoth() * countOfBoth());
    float squared_bias = 0.0;
    if (tileTexel(filter_guide, kGuidePlace, pixel).w > 0.0) {
        vec4 biases = imageLoad(smooth_from, pixel);
        vec2 variances = tileTexel(filter_from, kFilterCentre, pixel).zw;
        for (uint kind = 0u; kind < kKinds; ++kind) {
            vec3 d = demodulation(kind, pixel);
            vec3 x = ofBoth(lightOfHalf(kind, 0u, d, pixel), lightOfHalf(kind, 1u, d, pixel));
            uint tile = kFilterSpread + kHalves * kind;
            vec4 f_a = tileTexel(filter_from, tile, pixel), f_b = tileTexel(filter_from, tile + 1u, pixel);
            float variance = variances[kind] / countOfBoth();
            // That near by stands out where it is above twice its noise: of the product of two halves' means, over so many pixels.
            float noise = 2.0 * variances[kind] * inversesqrt(push.count_a * push.count_b * kNarrowPixels);
            float bias = max(max(biases[kind], biases[2u + kind] - noise), 0.0);
            float share = variance > 0.0 ? variance / (variance + bias) : 0.0;
            mean.rgb += d * share * (ofBoth(f_a.rgb, f_b.rgb) - x);
            float left = (push.count_a * push.count_a * f_a.w + push.count_b * push.count_b * f_b.w) / (countOfBoth() * countOfBoth());
            float kept = 1.0 - share;
            squared_bias += meanSquare(d) * share * share * bias;
            error += d * d * (kept * kept * variance + share * share * (left + bias));
        }
    }
    imageStore(filtered, pixel, vec4(max(mean.rgb, vec3(0.0)), mean.a));
    imageStore(filtered_error, pixel, vec4(error, squared_bias));
}
