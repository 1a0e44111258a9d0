#include "licht/measure/metrics.h"

#include <cassert>
#include <numeric>

namespace licht {
namespace {

// Share of the squared mean that keeps dark pixels from ruling relMse.
constexpr double kDarkShare = 0.01;

/// The mean of term(test value, reference value) over pixels and channels.
template <typename Term>
double meanOf(const Image& test, const Image& reference, Term term) {
    assert(test.width == reference.width && test.height == reference.height &&
           test.channels == reference.channels);
    assert(!test.texels.empty());
    double sum = 0.0;
    for (std::size_t i = 0; i < test.texels.size(); ++i)
        sum += term(static_cast<double>(test.texels[i]), static_cast<double>(reference.texels[i]));
    return sum / static_cast<double>(test.texels.size());
}

}  // namespace

double mse(const Image& test, const Image& reference) {
    return meanOf(test, reference, [](double a, double b) { return (a - b) * (a - b); });
}

double relMse(const Image& test, const Image& reference) {
    const double mean = std::accumulate(reference.texels.begin(), reference.texels.end(), 0.0) /
                        static_cast<double>(reference.texels.size());
    return meanOf(test, reference, [floor = kDarkShare * mean * mean](double a, double b) {
        const double squared_error = (a - b) * (a - b);
        return squared_error == 0.0 ? 0.0 : squared_error / (b * b + floor);
    });
}

}  // namespace licht
