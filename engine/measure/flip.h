#pragma once
// How different two pictures look to someone who alternates between them: LDR-FLIP of Andersson, Nilsson,
// Akenine-Moeller, Oskarsson, Astrom and Fairchild 2020, "FLIP: A Difference Evaluator for Alternating
// Images".
#include <numbers>

#include "licht/image/image.h"

namespace licht {

/// Pixels in a degree of the visual field of who looks from 0.7 m at 3840 pixels in 0.7 m, as in the paper.
inline constexpr double kFlipPixelsPerDegree = 0.7 * (3840.0 / 0.7) * std::numbers::pi / 180.0;

/// What it takes for a while, in bytes a pixel: of one picture three channels of CIELAB and two of features,
/// of the other these, its three opponent channels, and a channel of doubles and two of floats while one is
/// filtered.
inline constexpr double kFlipBytesPerPixel = 5 * 4 + (5 + 3) * 4 + 8 + 2 * 4;

// Both pictures must have the same size and three channels, sRGB-encoded and in [0,1]; a degree must have at
// least one pixel.

/// How much each pixel's difference is seen, in [0,1]: one channel. 0 where colours are alike.
Image flipMap(const Image& test, const Image& reference, double pixels_per_degree = kFlipPixelsPerDegree);

/// The mean of that map.
double flip(const Image& test, const Image& reference, double pixels_per_degree = kFlipPixelsPerDegree);

/// The same of two linear pictures of three channels as `--tonemap none` shows them at exposure 0, before its
/// codes are rounded.
double flipAsDisplayed(const Image& test, const Image& reference);

/// What that takes for a while, in bytes a pixel: both pictures as they are shown, beside the rest.
inline constexpr double kFlipAsDisplayedBytesPerPixel = kFlipBytesPerPixel + 2 * 3 * 4;

}  // namespace licht
