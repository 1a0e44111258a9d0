#version 460
#extension GL_GOOGLE_include_directive : require
// Statistics of single pixels are noise themselves: their mean over the surface around each. The second pair keeps to the pixels near by.
#include "filter/filter.glsl"

layout(rgba32f, binding = kBindingSmoothFrom) uniform readonly image2D smooth_from;
layout(rgba32f, binding = kBindingSmoothTo) uniform writeonly image2D smooth_to;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!isInside(pixel)) return;
    Guide guide = guideOf(pixel);
    vec4 here = imageLoad(smooth_from, pixel);
    float weights = isTold(here) ? rowOfThree(0) * rowOfThree(0) : 0.0;
    vec4 sum = weights * here;
    for (int y = -1; y <= 1 && guide.place > 0.0; ++y) {
        for (int x = -1; x <= 1; ++x) {
            ivec2 offset = ivec2(x, y) * int(push.stride), tap = pixel + offset;
            if (offset == ivec2(0) || !isInside(tap)) continue;
            float surface = distanceFromSurface(guide, tap, offset);
            if (surface > kFarthest) continue;
            vec4 there = imageLoad(smooth_from, tap);
            if (!isTold(there)) continue;
            float w = rowOfThree(x) * rowOfThree(y) * exp(-surface);
            sum += w * there;
            weights += w;
        }
    }
    vec4 smoothed = weights > 0.0 ? sum / weights : here;
    smoothed.zw = mix(smoothed.zw, here.zw, bvec2(push.stride > kNarrow && isTold(here)));
    imageStore(smooth_to, pixel, smoothed);
}
