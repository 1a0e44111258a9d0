#version 460
#extension GL_GOOGLE_include_directive : require
// What is filtered: the demodulated light of both halves; and the noise of each pixel as far as it alone, or where it cannot tell the pixels beside it, say.
#include "filter/halves.glsl"
#include "pure/mirror.glsl"

layout(rgba32f, binding = kBindingFilterTo) uniform writeonly image2D filter_to;
layout(rgba32f, binding = kBindingSmoothTo) uniform writeonly image2D smooth_to;

// Of a sample, by how far the pixels beside this one differ: theirs is the only second opinion on a pixel whose samples all lie in one half.
float varianceBeside(uint kind, vec3 here, float count, Guide guide, ivec2 pixel) {
    float sum = 0.0, weights = 0.0;
    for (int y = -1; y <= 1 && guide.place > 0.0; ++y) {
        for (int x = -1; x <= 1; ++x) {
            ivec2 offset = ivec2(x, y), tap = pixel + offset;
            if (offset == ivec2(0) || !isInside(tap)) continue;
            float surface = distanceFromSurface(guide, tap, offset);
            if (surface > kFarthest) continue;
            Halves there = whole(halvesOf(kind, demodulation(kind, tap), tap));
            float w = exp(-surface);
            sum += w * meanSquare(ofBoth(there.a, there.b, there) - here) / (1.0 / count + 1.0 / countOf(there));
            weights += w;
        }
    }
    return weights > 0.0 ? sum / weights : meanSquare(here) * count;
}

// What pixels beside a mirror's differ by is what it shows, and no noise.
float noiseShareBeside(uint kind, ivec2 pixel) {
    if (kind == 0u) return 1.0;
    return 1.0 - mirrorLikeness(tileTexel(signal_sums, kSumFirstMirrored, pixel).a / (push.count_a + push.count_b));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!isInside(pixel)) return;
    vec2 variance = vec2(0.0);  // of a sample
    Guide guide = guideOf(pixel);
    for (uint kind = 0u; kind < kKinds; ++kind) {
        Halves h = halvesOf(kind, demodulation(kind, pixel), pixel);
        variance[kind] = isSplit(h) ? varianceBetween(h) : noiseShareBeside(kind, pixel) * varianceBeside(kind, whole(h).a, countOf(h), guide, pixel);
        h = whole(h);
        uint tile = kFilterSpread + kHalves * kind;
        imageStore(filter_to, tilePlace(imageSize(filter_to), push.size, tile, uvec2(pixel)), vec4(h.a, h.n_a));
        imageStore(filter_to, tilePlace(imageSize(filter_to), push.size, tile + 1u, uvec2(pixel)), vec4(h.b, h.n_b));
    }
    imageStore(filter_to, tilePlace(imageSize(filter_to), push.size, kFilterCentre, uvec2(pixel)), vec4(1.0));
    imageStore(smooth_to, pixel, vec4(variance, 0.0, 0.0));
}
