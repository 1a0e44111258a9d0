// The two halves of the samples: what is filtered, before it is.
#ifndef LICHT_FILTER_HALVES_GLSL
#define LICHT_FILTER_HALVES_GLSL
#include "filter/filter.glsl"
#include "shared/constants.h"

layout(constant_id = kConstantReprojects) const bool kReprojects = false;
layout(rgba32f, binding = kBindingSignalSums) uniform readonly image2D signal_sums;
layout(rgba32f, binding = kBindingPrior) uniform readonly image2D prior;

// A kind of light at a pixel, demodulated, mean over so many samples of each half: those of this view, and what earlier views have told.
struct Halves {
    vec3 a;
    vec3 b;
    float n_a;
    float n_b;
};

// By which a pixel's light of a kind is divided, and multiplied again. The floor keeps zero over zero away, and is for thin films, which mirror where what lies
// under them does not.
vec3 demodulation(uint kind, ivec2 pixel) {
    const float kFloor = 1e-4;
    return max(tileTexel(signal_sums, kSumFirstSpread + kind, pixel).rgb / (push.count_a + push.count_b), vec3(kFloor));
}

// Of one half, demodulated; RGB: sum; A: of so many samples.
vec4 sumOfHalf(uint kind, uint half_, vec3 demodulation, ivec2 pixel) {
    vec4 sum = vec4(tileTexel(signal_sums, kSumSpread + kHalves * kind + half_, pixel).rgb / demodulation, half_ == 0u ? push.count_a : push.count_b);
    // What a half without a sample holds may be anything.
    if (sum.a == 0.0) sum.rgb = vec3(0.0);
    if (kReprojects) {
        vec4 before = tileTexel(prior, kPriorSpread + kHalves * kind + half_, pixel);
        sum += vec4(before.a * before.rgb, before.a);
    }
    return sum;
}

Halves halvesOf(uint kind, vec3 demodulation, ivec2 pixel) {
    vec4 a = sumOfHalf(kind, 0u, demodulation, pixel), b = sumOfHalf(kind, 1u, demodulation, pixel);
    // Earlier views may count less than a sample.
    return Halves(a.a > 0.0 ? a.rgb / a.a : vec3(0.0), b.a > 0.0 ? b.rgb / b.a : vec3(0.0), a.a, b.a);
}

float countOf(Halves h) { return h.n_a + h.n_b; }

// Where all samples lie in one half, there is nothing that tells noise from light: both are that one then.
bool isSplit(Halves h) { return h.n_a > 0.0 && h.n_b > 0.0; }

Halves whole(Halves h) {
    if (isSplit(h)) return h;
    vec3 x = h.n_a > 0.0 ? h.a : h.b;
    return Halves(x, x, countOf(h), countOf(h));
}

// Of a value per sample, whose halves have these means: its variance, by one degree of freedom. The mean of n samples has 1/n of it.
float varianceBetween(Halves h) { return meanSquare(h.a - h.b) * h.n_a * h.n_b / countOf(h); }

// Both halves, weighed by their samples.
vec3 ofBoth(vec3 a, vec3 b, Halves h) { return (h.n_a * a + h.n_b * b) / countOf(h); }

// By how much earlier views move the mean of this view's samples; without any exactly nothing.
vec3 moveByPrior(uint kind, vec3 demodulation, Halves h, ivec2 pixel) {
    vec3 sum = vec3(0.0);
    if (push.count_a > 0.0) sum += tileTexel(signal_sums, kSumSpread + kHalves * kind, pixel).rgb;
    if (push.count_b > 0.0) sum += tileTexel(signal_sums, kSumSpread + kHalves * kind + 1u, pixel).rgb;
    vec3 now = sum / ((push.count_a + push.count_b) * demodulation);
    vec4 a = tileTexel(prior, kPriorSpread + kHalves * kind, pixel), b = tileTexel(prior, kPriorSpread + kHalves * kind + 1u, pixel);
    return (a.a * (a.rgb - now) + b.a * (b.rgb - now)) / countOf(h);
}

#endif
