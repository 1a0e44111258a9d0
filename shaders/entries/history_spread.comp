#version 460
#extension GL_GOOGLE_include_directive : require
// Gradients of single samples are noise: their sums over the squares around, never over time.
#include "shared/bindings.h"
#include "shared/signals.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Push { GradientPush push; };
layout(rgba32f, binding = kBindingGradientsFrom) uniform readonly image2D gradients_from;
layout(rgba32f, binding = kBindingGradientsTo) uniform writeonly image2D gradients_to;

void main() {
    ivec2 square = ivec2(gl_GlobalInvocationID.xy), size = imageSize(gradients_from);
    if (any(greaterThanEqual(square, size))) return;
    vec4 sum = vec4(0.0);
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            ivec2 tap = square + int(push.stride) * ivec2(x, y);
            if (any(lessThan(tap, ivec2(0))) || any(greaterThanEqual(tap, size))) continue;
            float w = (x == 0 ? 1.0 : 0.5) * (y == 0 ? 1.0 : 0.5);
            // A mean of squares by squared weights: the variance of the sum.
            sum += imageLoad(gradients_from, tap) * vec4(w, w * w, w, w);
        }
    }
    imageStore(gradients_to, square, sum);
}
