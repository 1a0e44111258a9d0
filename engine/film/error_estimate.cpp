#include "licht/film/error_estimate.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "licht/film/steady_means.h"
#include "licht/measure/metrics.h"

namespace licht {
namespace {

/// Mean of squared errors (of pixel, channel), each relative to what is shown there.
template <typename SquaredError>
double meanRelative(const Film& film, const SquaredError& squared_error) {
    const Image means = steadyMeans(film);
    const std::size_t pixels = std::size_t{film.size.x} * film.size.y;
    double picture_mean = 0.0;
    for (std::size_t i = 0; i < pixels; ++i)
        for (std::size_t c = 0; c < 3; ++c) picture_mean += static_cast<double>(film.mean.texels[4 * i + c]);
    picture_mean /= 3.0 * static_cast<double>(pixels);
    double sum = 0.0;
    for (std::size_t i = 0; i < pixels; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            sum += relativeSquare(squared_error(i, c), static_cast<double>(means.texels[3 * i + c]),
                                  picture_mean);
    return sum / (3.0 * static_cast<double>(pixels));
}

constexpr double kSteepestFall = 0.25;

}  // namespace

double relativeError(const Film& film) {
    if (film.variance.texels.empty() || (film.samples < 2 && film.unfiltered.texels.empty())) return -1.0;
    return std::sqrt(meanRelative(film, [&film](std::size_t i, std::size_t c) {
        return static_cast<double>(film.variance.texels[3 * i + c]);
    }));
}

ErrorEstimate::ErrorEstimate(Sequence sampler, std::uint32_t first_sample)
    : even_(sampler != Sequence::random), first_sample_(first_sample) {
    moved_.fill(-1.0);
}

double ErrorEstimate::look(const Film& film) {
    const double independent = relativeError(film);
    if (!even_) return independent;
    const std::uint32_t n = film.samples;
    if (std::has_single_bit(n) && first_sample_ % n == 0) {
        if (n == 2 * earlier_samples_)
            moved_[static_cast<std::size_t>(std::countr_zero(n))] =
                meanRelative(film, [&](std::size_t i, std::size_t c) {
                    const double difference = static_cast<double>(film.mean.texels[4 * i + c]) -
                                              static_cast<double>(earlier_.texels[4 * i + c]);
                    return difference * difference;
                });
        earlier_ = film.mean;
        earlier_samples_ = n;
    }
    if (independent < 0.0) return independent;
    double squared = 0.0;
    for (std::uint32_t k = 0; k < 32; ++k) {
        if ((n >> k & 1U) == 0) continue;
        const double share = static_cast<double>(1U << k) / n;
        const bool seen = k > 0 && moved_[k] >= 0.0 && moved_[k - 1] >= 0.0;
        squared += seen ? share * share * std::max(moved_[k], kSteepestFall * moved_[k - 1])
                        : share * independent * independent;
    }
    return std::sqrt(squared);
}

}  // namespace licht
