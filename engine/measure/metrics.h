#pragma once
#include "licht/image/image.h"

namespace licht {

// Both pictures must have the same size and channels.

/// Mean squared error over pixels and channels.
double mse(const Image& test, const Image& reference);

/// Relative mean squared error: the mean over pixels and channels of (a-b)^2 / (b^2 + 0.01 m^2), with the
/// test's value a, the reference's b and the reference's mean m. An all-black reference gives 0 for an equal
/// picture and infinity for any other.
double relMse(const Image& test, const Image& reference);

}  // namespace licht
