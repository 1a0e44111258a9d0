// Which numbers of a sample decide what: four uniform numbers a dimension. Reserved once, so that what comes later changes no picture that is without it.
#ifndef LICHT_SHARED_DIMENSIONS_H
#define LICHT_SHARED_DIMENSIONS_H
#include "seam.h"

LICHT_SHARED_BEGIN

// The camera's.
LICHT_CONSTANT uint kDimensionPixel = 0u;       // where in the pixel
LICHT_CONSTANT uint kDimensionLens = 1u;        // where on the lens
LICHT_CONSTANT uint kDimensionTime = 2u;        // when, while the shutter is open
LICHT_CONSTANT uint kDimensionWavelength = 3u;  // which wavelengths
// Then those of each bounce: kDimensionBounce + kDimensionsPerBounce * bounce + one of these.
LICHT_CONSTANT uint kDimensionBounce = 4u;
LICHT_CONSTANT uint kDimensionLight = 0u;    // which light, and where on it
LICHT_CONSTANT uint kDimensionScatter = 1u;  // whither, by which lobe, and roulette
LICHT_CONSTANT uint kDimensionSky = 2u;      // where in the sky
LICHT_CONSTANT uint kDimensionMedium = 3u;   // how far through a medium
LICHT_CONSTANT uint kDimensionsPerBounce = 4u;

// Coverage of partly transparent surfaces: kDimensionCoverage + the number of the ray that meets them. The camera's ray is 0, then there are
// kRaysPerBounce a bounce: kRayToLight or kRayOnward + kRaysPerBounce * bounce.
LICHT_CONSTANT uint kDimensionCoverage = 0x80000000u;
LICHT_CONSTANT uint kRayToLight = 1u;
LICHT_CONSTANT uint kRayOnward = 2u;
LICHT_CONSTANT uint kRaysPerBounce = 2u;

LICHT_SHARED_END
#endif
