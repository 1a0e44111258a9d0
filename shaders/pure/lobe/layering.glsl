// How a layer that reflects lies over one that spreads light evenly, so that both together give what they get.
#ifndef LICHT_PURE_LOBE_LAYERING_GLSL
#define LICHT_PURE_LOBE_LAYERING_GLSL

#include "shared/choices.h"
#include "shared/constants.h"

layout(constant_id = kConstantLayering) const uint kLayering = kLayeringAlbedo;

// Light passes a layer in and out: left_o and left_i are what it leaves of the light of each direction, mean_left of all of them. A white layer below then
// sends towards wo just what is left of that direction, whatever the roughness. Reciprocal. Kelemen and Szirmay-Kalos 2001, A Microfacet Based Coupled
// Specular-Matte BRDF Model with Importance Sampling.
float passedBothWays(float left_o, float left_i, float mean_left) {
    const float kLeast = 1e-3;  // what reflects all but that much hides what lies below
    return mean_left > kLeast ? left_o * left_i / mean_left : 0.0;
}

#endif
