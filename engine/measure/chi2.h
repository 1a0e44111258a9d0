#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

namespace licht {

/// Regularised upper incomplete gamma function Q(a, x) = Gamma(a, x) / Gamma(a), for a > 0 and x >= 0.
double upperIncompleteGamma(double a, double x);

struct ChiSquareResult {
    double statistic = 0.0;
    std::size_t degrees = 0;  ///< degrees of freedom: cells after pooling, less one
    double p = 1.0;  ///< probability of a statistic at least this large when the expectation is right
};

/// Pearson's chi-square test of observed counts against expected ones, which must have the same total up to
/// rounding. Cells that expect fewer than 5 are pooled (Cochran 1954, "Some methods for strengthening the
/// common chi-square tests"). A count in a cell that expects none gives p = 0; fewer than two cells after
/// pooling give p = 1 with degrees = 0.
ChiSquareResult chiSquareTest(std::span<const std::uint64_t> observed, std::span<const double> expected);

}  // namespace licht
