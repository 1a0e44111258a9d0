#version 460
#extension GL_GOOGLE_include_directive : require
// The picture: of each kind of light the mean of all samples, moved towards what the filter made of it as far as the noise that goes outweighs the bias that
// comes. Where the filter is biased its share falls as the noise does, so the picture converges to the truth; and what is left of both is its squared error.
#include "filter/halves.glsl"

layout(constant_id = kConstantSpatial) const bool kSpatial = true;
layout(rgba32f, binding = kBindingMeanHigh) uniform readonly image2D mean_high;
layout(rgba32f, binding = kBindingSquaresHigh) uniform readonly image2D squares_high;  // sums of squared deviations, of this view's samples
layout(rgba32f, binding = kBindingFilterFrom) uniform readonly image2D filter_from;
// Squared biases, far and near; without the spatial filter variances of a sample.
layout(rgba32f, binding = kBindingSmoothFrom) uniform readonly image2D smooth_from;
layout(rgba32f, binding = kBindingFiltered) uniform writeonly image2D filtered;
layout(rgba32f, binding = kBindingFilteredError) uniform writeonly image2D filtered_error;

// What the filter makes of a kind of light, demodulated.
struct Part {
    vec3 move;       // from the mean of all samples to what the filter made of it
    float variance;  // of that mean
    float left;      // of what the filter made of it
    float bias;      // of that, squared
    float share;     // of the move that is made
};

Part partOf(uint kind, Halves h, float of_sample, vec4 biases, ivec2 pixel) {
    float variance = of_sample / countOf(h);
    if (!kSpatial) return Part(vec3(0.0), variance, 0.0, 0.0, 0.0);
    bool split_ = isSplit(h);
    vec3 x = ofBoth(h.a, h.b, h);
    h = whole(h);
    uint tile = kFilterSpread + kHalves * kind;
    vec4 f_a = tileTexel(filter_from, tile, pixel), f_b = tileTexel(filter_from, tile + 1u, pixel);
    // That near by stands out where it is above twice its noise: of the product of two halves' means, over so many pixels.
    float noise = 2.0 * of_sample * inversesqrt(h.n_a * h.n_b * kNarrowPixels);
    float bias = max(max(biases[kind], biases[2u + kind] - noise), 0.0);
    float left = split_ ? (h.n_a * h.n_a * f_a.w + h.n_b * h.n_b * f_b.w) / (countOf(h) * countOf(h)) : f_a.w;
    return Part(ofBoth(f_a.rgb, f_b.rgb, h) - x, variance, left, bias, variance > 0.0 ? variance / (variance + bias) : 0.0);
}

// A pixel whose own samples agree is what they say, however much those around it differ, as small things do and what mirrors show: so many of its standard
// deviations are the most that it moves. Samples that have met no rare light agree as well, so those around it count like so many more.
float shareWithinOwnNoise(vec3 move, float variance_around, ivec2 pixel) {
    const float kMostDeviations = 2.0, kSamplesAround = 3.0;
    float n = push.count_a + push.count_b;
    if (n < 2.0) return 1.0;
    float own = dot(imageLoad(squares_high, pixel).rgb, vec3(1.0 / 3.0)) / (n - 1.0);
    float of_sample = (n * own + kSamplesAround * variance_around) / (n + kSamplesAround);
    float most = kMostDeviations * kMostDeviations * of_sample / n, moved = meanSquare(move);
    return moved > most ? sqrt(most / moved) : 1.0;
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
        Part parts[2];
        vec3 move = vec3(0.0);
        float of_sample = 0.0;
        for (uint kind = 0u; kind < kKinds; ++kind) {
            vec3 d = demodulation(kind, pixel);
            Halves h = halvesOf(kind, d, pixel);
            parts[kind] = partOf(kind, h, variances[kind], smooth_, pixel);
            move += d * parts[kind].share * parts[kind].move;
            of_sample += meanSquare(d) * variances[kind];
            if (kReprojects) mean.rgb += d * moveByPrior(kind, d, h, pixel);
        }
        float within = kSpatial ? shareWithinOwnNoise(move, of_sample, pixel) : 0.0;
        mean.rgb += within * move;
        for (uint kind = 0u; kind < kKinds; ++kind) {
            Part part = parts[kind];
            vec3 d = demodulation(kind, pixel);
            float share = within * part.share, kept = 1.0 - share;
            squared_bias += meanSquare(d) * share * share * part.bias;
            error += d * d * (kept * kept * part.variance + share * share * (part.left + part.bias));
        }
    }
    imageStore(filtered, pixel, vec4(max(mean.rgb, vec3(0.0)), mean.a));
    imageStore(filtered_error, pixel, vec4(error, squared_bias));
}
