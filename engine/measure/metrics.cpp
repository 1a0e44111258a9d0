#include "licht/measure/metrics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>

namespace licht {
namespace {

void requireAlike([[maybe_unused]] const Image& test, [[maybe_unused]] const Image& reference) {
    assert(test.width == reference.width && test.height == reference.height &&
           test.channels == reference.channels);
    assert(!test.texels.empty());
}

double squaredDifference(const Image& test, const Image& reference, std::size_t i) {
    const double difference = static_cast<double>(test.texels[i]) - static_cast<double>(reference.texels[i]);
    return difference * difference;
}

double meanOf(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

double mse(const Image& test, const Image& reference) {
    requireAlike(test, reference);
    double sum = 0.0;
    for (std::size_t i = 0; i < test.texels.size(); ++i) sum += squaredDifference(test, reference, i);
    return sum / static_cast<double>(test.texels.size());
}

std::vector<double> relativeSquares(const Image& test, const Image& reference) {
    requireAlike(test, reference);
    const double mean = meanOf(channelMeans(reference));
    const auto channels = static_cast<std::size_t>(test.channels);
    std::vector<double> pixels(test.texels.size() / channels);
    for (std::size_t i = 0; i < test.texels.size(); ++i)
        pixels[i / channels] += relativeSquare(squaredDifference(test, reference, i),
                                               static_cast<double>(reference.texels[i]), mean) /
                                static_cast<double>(channels);
    return pixels;
}

double relMse(const Image& test, const Image& reference) {
    return meanOf(relativeSquares(test, reference));
}

double trimmedRelMse(const Image& test, const Image& reference) {
    std::vector<double> pixels = relativeSquares(test, reference);
    const auto worst = static_cast<std::ptrdiff_t>(kTrimmedShare * static_cast<double>(pixels.size()));
    std::nth_element(pixels.begin(), pixels.begin() + worst, pixels.end(), std::greater<>());
    pixels.erase(pixels.begin(), pixels.begin() + worst);
    return meanOf(pixels);
}

double largestDifference(const Image& test, const Image& reference) {
    requireAlike(test, reference);
    double largest = 0.0;
    for (std::size_t i = 0; i < test.texels.size(); ++i)
        largest = std::max(largest, std::sqrt(squaredDifference(test, reference, i)));
    return largest;
}

std::vector<double> channelMeans(const Image& image) {
    assert(!image.texels.empty());
    const auto channels = static_cast<std::size_t>(image.channels);
    std::vector<double> means(channels);
    for (std::size_t i = 0; i < image.texels.size(); ++i)
        means[i % channels] += static_cast<double>(image.texels[i]);
    for (double& mean : means) mean /= static_cast<double>(image.texels.size() / channels);
    return means;
}

}  // namespace licht
