#version 460
#extension GL_GOOGLE_include_directive : require
// The history: mean and variance of every pixel, all samples weighted alike.
#include "path/adaptive.glsl"
#include "pure/running_mean.glsl"
#include "shared/bindings.h"
#include "shared/frame.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Push { SamplePush push; };
layout(rgba32f, binding = kBindingRadiance) uniform readonly image2D radiance_image;
layout(rgba32f, binding = kBindingMeanHigh) uniform image2D mean_high;
layout(rgba32f, binding = kBindingMeanLow) uniform image2D mean_low;
layout(rgba32f, binding = kBindingSquaresHigh) uniform image2D squares_high;
layout(rgba32f, binding = kBindingSquaresLow) uniform image2D squares_low;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(mean_high)))) return;
    if (!isSampled(uvec2(pixel), uint(imageSize(mean_high).x), push.sample_index)) return;
    // The first sample selects zeros instead of branching: lavapipe compiles a program anew for each value of a push constant that
    // decides a branch. What the images hold before the first sample is anything, so a product with zero would not do.
    bvec4 fresh = bvec4(push.count_before == 0u);
    RunningMean r;
    r.mean = TwoFloat4(mix(imageLoad(mean_high, pixel), vec4(0.0), fresh), mix(imageLoad(mean_low, pixel), vec4(0.0), fresh));
    r.squares = TwoFloat4(mix(imageLoad(squares_high, pixel), vec4(0.0), fresh), mix(imageLoad(squares_low, pixel), vec4(0.0), fresh));
    r = addSample(r, imageLoad(radiance_image, pixel), float(push.count_before) + 1.0);
    imageStore(mean_high, pixel, r.mean.high);
    imageStore(mean_low, pixel, r.mean.low);
    imageStore(squares_high, pixel, r.squares.high);
    imageStore(squares_low, pixel, r.squares.low);
}
