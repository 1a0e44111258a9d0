#pragma once
#include <vector>

#include "licht/image/image.h"

namespace licht {

/// A squared error relative to the reference's value b in a picture of mean m: error / (b^2 + 0.01 m^2),
/// where the share of m keeps dark pixels from ruling. No error is 0 even where both are black.
inline double relativeSquare(double squared_error, double reference, double picture_mean) {
    constexpr double kDarkShare = 0.01;
    return squared_error == 0.0
               ? 0.0
               : squared_error / (reference * reference + kDarkShare * picture_mean * picture_mean);
}

// Both pictures must have the same size and channels.

/// Mean squared error over pixels and channels.
double mse(const Image& test, const Image& reference);

/// Of each pixel the mean over channels of relativeSquare of their squared differences, with the mean of the
/// reference.
std::vector<double> relativeSquares(const Image& test, const Image& reference);

/// Relative mean squared error: the mean over pixels of relativeSquares. An all-black reference gives
/// 0 for an equal picture and infinity for any other.
double relMse(const Image& test, const Image& reference);

/// The share of the pixels, those with the greatest error, that trimmedRelMse leaves out, rounded down to
/// whole pixels.
inline constexpr double kTrimmedShare = 0.001;

/// relMse without its worst pixels, by each pixel's mean over channels: what is left says how the picture
/// looks when a few bright outliers rule the whole.
double trimmedRelMse(const Image& test, const Image& reference);

/// The largest absolute difference of two values.
double largestDifference(const Image& test, const Image& reference);

/// The mean of each channel.
std::vector<double> channelMeans(const Image& image);

}  // namespace licht
