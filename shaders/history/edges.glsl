// Which pixels show which surface, where several meet: edges.
#ifndef LICHT_HISTORY_EDGES_GLSL
#define LICHT_HISTORY_EDGES_GLSL
#include "history/reproject.glsl"
#include "shared/bindings.h"

layout(rgba32f, binding = kBindingSampleSignals) uniform readonly image2D sample_signals;

// Of the pixel's sample. XYZ: normal; W: depth along the axis.
vec4 placeAt(ivec2 pixel) { return imageLoad(sample_signals, tilePlace(imageSize(sample_signals), frame.view.size, kFirstPlace, uvec2(pixel))); }

bool isInside(ivec2 pixel) { return all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(pixel, ivec2(frame.view.size))); }

// Whether the sample of a pixel is of the surface that has this point. A picture's pixel is about 2 scale / height of the distance wide; a plane seen aslant
// is met as far off.
bool isOf(ivec2 pixel, uint instance, vec3 position, vec3 normal) {
    const float kFacing = 0.7;
    if (gbufferHit(pixel).instance != instance) return false;
    if (instance == kNoIndex) return true;
    vec4 place = placeAt(pixel);
    if (abs(dot(place.xyz, normal)) < kFacing) return false;
    float reach = 2.0 * frame.view.scale_y / float(frame.view.size.y) * (frame.view.orthographic != 0u ? 1.0 : place.w);
    return abs(dot(place.xyz, positionIn(frame.view, pixel, place.w) - position)) < 2.0 * reach;
}

#endif
