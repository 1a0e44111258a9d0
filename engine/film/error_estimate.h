#pragma once
// How wrong a picture still is, where samples are spread more evenly than by chance.
#include <array>
#include <cstdint>

#include "licht/film/film.h"
#include "licht/settings/settings.h"

namespace licht {

/// sqrt of the estimated relMSE: mean over pixels and channels of variance of the mean / (mean^2 + 0.01 *
/// (the picture's mean)^2), by steadyMeans (steady_means.h). Negative while it is unknown (fewer than two
/// samples, not filtered; a filter that does not say). As if samples were independent: for those of an even
/// sequence ErrorEstimate is closer.
double relativeError(const Film& film);

/// Estimates the error of a picture from how it moves while it is rendered.
///
/// The variance of samples over their number is the squared error of independent samples. Those of the
/// sequences sobol and blue come in blocks of 2^k, spread evenly each, and blocks of a size are
/// exchangeable. With V(n) the variance of the mean of a block of n, the mean of 2n samples differs from that
/// of the first n of them by E (M(2n) - M(n))^2 = V(n) - V(2n): half the difference of two blocks whose
/// covariance is 2 V(2n) - V(n). That is V(2n) where samples are independent, and more where doubling them
/// does better than to halve the variance. So it is taken for the error of 2n samples. Of n samples in
/// general, blocks as the binary digits of n say are put together as if they were independent; their
/// covariance is not positive under the same condition.
///
/// Where one doubling does worse than to halve the variance the estimate is too low: scrambled nets may
/// double the variance that a texture has at the very scale of their boxes, and lose it one doubling later
/// (Owen 1997, Monte Carlo Variance of Scrambled Net Quadrature). If all pixels did so at once the picture
/// would hardly move, so an estimate is at least a quarter of the one before it: the variance's fall where
/// errors fall with 1/n.
class ErrorEstimate {
public:
    ErrorEstimate(Sequence sampler, std::uint32_t first_sample);

    /// Of a film whose samples are weighted alike, relative as relativeError() is; negative while unknown.
    /// The films of one picture as it grows: those of 2^k samples are learnt from. Where three of them in a
    /// row were not seen, and for independent samples, this is relativeError().
    double look(const Film& film);

private:
    bool even_;
    std::uint32_t first_sample_;
    Image earlier_;  ///< mean of the last film of 2^k samples
    std::uint32_t earlier_samples_ = 0;
    std::array<double, 32>
        moved_{};  ///< squared and relative, by the doubling to 2^k samples; negative: not seen
};

}  // namespace licht
