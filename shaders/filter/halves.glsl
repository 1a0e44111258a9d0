// The two halves of the samples: what is filtered, before it is.
#ifndef LICHT_FILTER_HALVES_GLSL
#define LICHT_FILTER_HALVES_GLSL
#include "filter/filter.glsl"

layout(rgba32f, binding = kBindingSignalSums) uniform readonly image2D signal_sums;

float countOf(uint half_) { return half_ == 0u ? push.count_a : push.count_b; }
float countOfBoth() { return push.count_a + push.count_b; }

// Of a value per sample, whose halves have these means: its variance, by one degree of freedom. The mean of n samples has 1/n of it.
float varianceBetween(vec3 a, vec3 b) { return meanSquare(a - b) * push.count_a * push.count_b / countOfBoth(); }

// By which a pixel's light of a kind is divided, and multiplied again. The floor keeps zero over zero away, and is for thin films, which mirror where what lies
// under them does not.
vec3 demodulation(uint kind, ivec2 pixel) {
    const float kFloor = 1e-4;
    return max(tileTexel(signal_sums, kSumFirstSpread + kind, pixel).rgb / countOfBoth(), vec3(kFloor));
}

// Demodulated light of a kind, mean over a half.
vec3 lightOfHalf(uint kind, uint half_, vec3 demodulation, ivec2 pixel) {
    return tileTexel(signal_sums, kSumSpread + kHalves * kind + half_, pixel).rgb / (countOf(half_) * demodulation);
}

// Both halves, weighed by their samples.
vec3 ofBoth(vec3 a, vec3 b) { return (push.count_a * a + push.count_b * b) / countOfBoth(); }

#endif
