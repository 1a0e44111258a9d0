// What the passes of the spatial filter share: their images, and which pixels show one surface.
// Dammertz, Sewtz, Hanika, Lensch 2010, Edge-Avoiding A-Trous Wavelet Transform for fast Global Illumination Filtering: a few taps, farther apart from level to
// level. Schied et al. 2017, Spatiotemporal Variance-Guided Filtering: taps are weighed by the noise that differences have. Rousselle, Knaus, Zwicker 2012,
// Adaptive Rendering with Non-Local Means Filtering: two halves of the samples, each filtered with the weights of the other, so that no noise votes for itself.
#ifndef LICHT_FILTER_FILTER_GLSL
#define LICHT_FILTER_FILTER_GLSL
#include "pure/lobe/lobe.glsl"
#include "pure/tiles.glsl"
#include "shared/bindings.h"
#include "shared/effects.h"
#include "shared/signals.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = kEffectGlossy) const bool kGlossy = true;
layout(push_constant) uniform Push { FilterPush push; };
layout(rgba32f, binding = kBindingFilterGuide) uniform readonly image2D filter_guide;

const uint kKinds = kGlossy ? 2u : 1u;  // of light: spread, mirrored

// What a picture's pixel has in an image of tiles.
#define tileTexel(image, tile, pixel) imageLoad(image, tilePlace(imageSize(image), push.size, tile, uvec2(pixel)))

bool isInside(ivec2 pixel) { return all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(pixel, ivec2(push.size))); }

float meanSquare(vec3 c) { return dot(c, c) / 3.0; }

// Weights of taps in a row, whose products by two rows sum to one: of five taps, and of three.
float rowOfFive(int tap) { return tap == 0 ? 0.375 : abs(tap) == 1 ? 0.25 : 0.0625; }
float rowOfThree(int tap) { return tap == 0 ? 0.5 : 0.25; }

// Statistics near by are means of taps no farther apart than this: by three taps, and two pixels apart three more, 32 pixels count (4 pi sigma^2).
const uint kNarrow = 2u;
const float kNarrowPixels = 32.0;

// A pixel that has nothing to say about a statistic says this, and is not asked; anything far below all values.
const float kUntold = -1e30;
bool isTold(vec4 statistics) { return statistics.x > 0.5 * kUntold; }

struct Guide {
    vec3 normal;
    float place;  // linear over a plane's picture; 0: there is no surface
    vec2 slope;   // of place
    ivec2 origin; // of the places of all pixels
};

Guide guideOf(ivec2 pixel) {
    vec4 place = tileTexel(filter_guide, kGuidePlace, pixel);
    return Guide(place.xyz, place.w, tileTexel(filter_guide, kGuideSlope, pixel).xy, tileOrigin(imageSize(filter_guide), push.size, kGuidePlace));
}

// How little a tap shows the surface of the centre: how far it is off its plane, but for what the slope's own error and curved surfaces make, and how far it
// faces another way. The tap's weight is e to minus this; weights of several reasons to differ take one exponential.
const float kOtherSurface = 1e4;
float distanceFromSurface(Guide centre, ivec2 tap, ivec2 offset) {
    const float kOffPlane = 0.01;   // of the distance
    const float kOffSlope = 0.125;  // of what the slope makes of the offset
    const float kFacing = 64.0;     // e^-1 at ten degrees
    vec4 there = imageLoad(filter_guide, centre.origin + tap);
    vec2 along = centre.slope * vec2(offset);
    float off = abs(there.w - centre.place - along.x - along.y) / (kOffPlane * centre.place + kOffSlope * (abs(along.x) + abs(along.y)));
    return there.w > 0.0 ? off + kFacing * (1.0 - dot(there.xyz, centre.normal)) : kOtherSurface;
}

// Beyond, a tap has no part, and what it holds may be anything.
const float kFarthest = 12.0;

#endif
