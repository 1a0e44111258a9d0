#pragma once
#include "licht/image/image.h"

namespace licht {

/// A noisy picture: per pixel and channel the mean and the variance of that mean (not of one sample).
struct Estimate {
    const Image& mean;
    const Image& variance;
};

/// Outcome of zTest. A p-value is the probability of a difference at least this large when both estimate the
/// same picture.
struct ZTestResult {
    Image p_values;           ///< per pixel and channel
    double pass_share = 0.0;  ///< share of p_values above the per-pixel threshold
    double smallest_p = 1.0;  ///< of p_values
    /// Sums over blocks of kBlockSide x kBlockSide pixels and over the whole picture, per channel: they see a
    /// bias far below the noise of one pixel.
    double smallest_block_p = 1.0;
    double block_threshold = 0.0;
    double smallest_whole_p = 1.0;
    double whole_threshold = 0.0;

    static constexpr int kBlockSide = 16;
    /// The share of pixels that must pass, as in Mitsuba 3 (src/render/tests/test_renders.py): a few outliers
    /// are allowed, because the variance of a pixel is itself an estimate.
    static constexpr double kWantedShare = 0.9975;

    /// Blocks and whole alone: for few samples, where the variance of a pixel is too poor an estimate.
    [[nodiscard]] bool regionsPassed() const {
        return smallest_block_p > block_threshold && smallest_whole_p > whole_threshold;
    }
    [[nodiscard]] bool passed(double wanted_share = kWantedShare) const {
        return pass_share >= wanted_share && regionsPassed();
    }
};

/// Two-sample z-test of equal means per pixel and channel, z = (a-b) / sqrt(var a + var b), with the
/// significance corrected for the number of tests (Sidak 1967, "Rectangular confidence regions for the means
/// of multivariate normal distributions"): 0.01 over the pixels, and 0.001 each over the blocks and over the
/// channels of the whole picture. Values within a few rounding errors of each other count as equal; without
/// any variance others count as different. A value that is not finite or a negative variance fails. All
/// images must have one size and number of channels.
ZTestResult zTest(const Estimate& a, const Estimate& b);

/// Per-test significance that gives `significance` over `tests` independent tests together.
double sidakThreshold(double significance, double tests);

}  // namespace licht
