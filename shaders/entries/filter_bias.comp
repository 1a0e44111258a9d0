#version 460
#extension GL_GOOGLE_include_directive : require
// By how much the filter moved each pixel beside the truth, as far as the pixel alone can tell. With x the mean of a half of the samples and f what the filter
// made of it, (x_A - f_B) (x_B - f_A) has the squared bias as its expectation but for x and f of one half, which share the pixel's own light: their covariance,
// the centre's weight times the variance of x, is added for both halves.
#include "filter/halves.glsl"

layout(rgba32f, binding = kBindingFilterFrom) uniform readonly image2D filter_from;
layout(rgba32f, binding = kBindingSmoothTo) uniform writeonly image2D smooth_to;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!isInside(pixel)) return;
    vec2 bias = vec2(0.0);  // squared; negative where noise has it so
    bool told = true;
    if (tileTexel(filter_guide, kGuidePlace, pixel).w > 0.0) {
        vec4 centre = tileTexel(filter_from, kFilterCentre, pixel);
        for (uint kind = 0u; kind < kKinds; ++kind) {
            vec3 d = demodulation(kind, pixel);
            uint tile = kFilterSpread + kHalves * kind;
            vec3 f_a = tileTexel(filter_from, tile, pixel).rgb, f_b = tileTexel(filter_from, tile + 1u, pixel).rgb;
            Halves x = halvesOf(kind, d, pixel);
            if (!isSplit(x)) {
                told = false;
                break;
            }
            vec3 product = (x.a - f_b) * (x.b - f_a);
            bias[kind] = dot(product, vec3(1.0 / 3.0)) + centre[kind] * centre[2u + kind] * (1.0 / x.n_a + 1.0 / x.n_b);
        }
    }
    imageStore(smooth_to, pixel, told ? vec4(bias, bias) : vec4(kUntold));
}
