#pragma once
#include "licht/film/film.h"

namespace licht {

/// What each pixel shows, RGB, told steadily enough to hold its error against. The pixel's own mean is high
/// just where rare light was found, which is where its error is, too: relative to it errors look small, and
/// where none was found yet they are not known. So the mean of 5x5 pixels around helps, by inverse variances
/// (Aitken 1936, "On least squares and linear combinations of observations"): the pixel's is that of the
/// pixels around and a little of its own, theirs has what they differ by beyond noise, so that edges and
/// textures stay.
Image steadyMeans(const Film& film);

}  // namespace licht
