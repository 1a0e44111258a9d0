#version 460
#extension GL_GOOGLE_include_directive : require
// What is filtered: the demodulated light of both halves; and the noise of each pixel as far as it alone can tell.
#include "filter/halves.glsl"

layout(rgba32f, binding = kBindingFilterTo) uniform writeonly image2D filter_to;
layout(rgba32f, binding = kBindingSmoothTo) uniform writeonly image2D smooth_to;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!isInside(pixel)) return;
    vec2 variance = vec2(0.0);  // of a sample
    for (uint kind = 0u; kind < kKinds; ++kind) {
        vec3 d = demodulation(kind, pixel);
        vec3 a = lightOfHalf(kind, 0u, d, pixel), b = lightOfHalf(kind, 1u, d, pixel);
        variance[kind] = varianceBetween(a, b);
        uint tile = kFilterSpread + kHalves * kind;
        imageStore(filter_to, tilePlace(imageSize(filter_to), push.size, tile, uvec2(pixel)), vec4(a, 0.0));
        imageStore(filter_to, tilePlace(imageSize(filter_to), push.size, tile + 1u, uvec2(pixel)), vec4(b, 0.0));
    }
    imageStore(filter_to, tilePlace(imageSize(filter_to), push.size, kFilterCentre, uvec2(pixel)), vec4(1.0));
    imageStore(smooth_to, pixel, vec4(variance, 0.0, 0.0));
}
