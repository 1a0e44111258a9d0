#version 460
#extension GL_GOOGLE_include_directive : require
// From the history's mean to what a display shows.
#include "pure/tonemap.glsl"
#include "shared/bindings.h"
#include "shared/choices.h"
#include "shared/frame.h"
#include "shared/transfer.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Push { TonemapPush push; };
layout(rgba32f, binding = kBindingMeanHigh) uniform readonly image2D mean_high;
layout(rgba8, binding = kBindingDisplay) uniform writeonly image2D display_image;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(display_image)))) return;
    // Largest finite value that every curve survives.
    vec3 c = clamp(imageLoad(mean_high, pixel).rgb * push.exposure, vec3(0.0), vec3(1e30));
    if (push.curve == kTonemapNeutral) c = tonemapNeutral(c);
    if (push.curve == kTonemapAgx) c = tonemapAgx(c);
    if (push.curve == kTonemapAces) c = tonemapAces(c);
    c = clamp(c, vec3(0.0), vec3(1.0));
    imageStore(display_image, pixel, vec4(srgbFromLinear(c.r), srgbFromLinear(c.g), srgbFromLinear(c.b), 1.0));
}
