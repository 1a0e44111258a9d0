// Which numbers of a sample decide what.
#ifndef LICHT_SHARED_DIMENSIONS_H
#define LICHT_SHARED_DIMENSIONS_H
#include "seam.h"

LICHT_SHARED_BEGIN

// The first dimensions of a sample belong to the camera, then each bounce takes its own few.
LICHT_CONSTANT uint kDimensionCamera = 0u;
LICHT_CONSTANT uint kDimensionBounce = 1u;  // + kDimensionsPerBounce * bounce + one of these:
LICHT_CONSTANT uint kDimensionLight = 0u;
LICHT_CONSTANT uint kDimensionScatter = 1u;  // and roulette
LICHT_CONSTANT uint kDimensionEnvironment = 2u;
LICHT_CONSTANT uint kDimensionsPerBounce = 3u;
LICHT_CONSTANT uint kDimensionAlpha = 0x80000000u;  // + rays traced so far: coverage of partly transparent surfaces

LICHT_SHARED_END
#endif
