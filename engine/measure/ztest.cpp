#include "licht/measure/ztest.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace licht {
namespace {

constexpr double kPixelSignificance = 0.01;
// Every block has to pass, so a right picture fails once in 1/kRegionSignificance comparisons.
constexpr double kRegionSignificance = 0.001;
// Two correctly computed floats may differ by the order of their summation: four units in the last place.
constexpr double kRounding = 4.0 * static_cast<double>(std::numeric_limits<float>::epsilon());

/// A difference of means and its variance; they add up over pixels.
struct Difference {
    double value = 0.0;
    double variance = 0.0;

    Difference& operator+=(const Difference& other) {
        value += other.value;
        variance += other.variance;
        return *this;
    }
    /// Two-sided p-value of a normal variate.
    [[nodiscard]] double pValue() const {
        if (!std::isfinite(value) || !std::isfinite(variance)) return 0.0;
        if (value == 0.0) return 1.0;
        return std::erfc(std::abs(value) / std::sqrt(variance) / std::numbers::sqrt2);
    }
};

Difference differenceAt(const Estimate& a, const Estimate& b, std::size_t i) {
    const auto a_mean = static_cast<double>(a.mean.texels[i]);
    const auto b_mean = static_cast<double>(b.mean.texels[i]);
    const auto a_variance = static_cast<double>(a.variance.texels[i]);
    const auto b_variance = static_cast<double>(b.variance.texels[i]);
    // NaN survives into the sums, where pValue() fails it.
    if (!(a_variance >= 0.0) || !(b_variance >= 0.0)) return {0.0, std::numeric_limits<double>::quiet_NaN()};
    const double difference = a_mean - b_mean;
    const bool equal = std::isfinite(difference) &&
                       std::abs(difference) <= kRounding * std::max(std::abs(a_mean), std::abs(b_mean));
    return {equal ? 0.0 : difference, a_variance + b_variance};
}

}  // namespace

double sidakThreshold(double significance, double tests) {
    // 1 - (1 - significance)^(1 / tests) without cancellation.
    return -std::expm1(std::log1p(-significance) / tests);
}

ZTestResult zTest(const Estimate& a, const Estimate& b) {
    const Image& like = a.mean;
    for ([[maybe_unused]] const Image* image : {&a.variance, &b.mean, &b.variance})
        assert(image->width == like.width && image->height == like.height &&
               image->channels == like.channels);
    assert(!like.texels.empty());

    constexpr int side = ZTestResult::kBlockSide;
    const int blocks_across = (like.width + side - 1) / side;
    const int blocks_down = (like.height + side - 1) / side;
    const Image layout(blocks_across, blocks_down, like.channels);
    std::vector<Difference> blocks(layout.texels.size());
    std::vector<Difference> whole(static_cast<std::size_t>(like.channels));

    ZTestResult result;
    result.p_values = Image(like.width, like.height, like.channels);
    const double pixel_threshold = sidakThreshold(
        kPixelSignificance, static_cast<double>(like.width) * static_cast<double>(like.height));
    std::size_t passing = 0;
    for (int y = 0; y < like.height; ++y)
        for (int x = 0; x < like.width; ++x)
            for (int c = 0; c < like.channels; ++c) {
                const std::size_t i = like.index(x, y, c);
                const Difference difference = differenceAt(a, b, i);
                const double p = difference.pValue();
                result.p_values.texels[i] = static_cast<float>(p);
                result.smallest_p = std::min(result.smallest_p, p);
                passing += p > pixel_threshold ? 1 : 0;
                blocks[layout.index(x / side, y / side, c)] += difference;
                whole[static_cast<std::size_t>(c)] += difference;
            }
    result.pass_share = static_cast<double>(passing) / static_cast<double>(like.texels.size());

    result.block_threshold = sidakThreshold(kRegionSignificance, static_cast<double>(blocks.size()));
    for (const Difference& block : blocks)
        result.smallest_block_p = std::min(result.smallest_block_p, block.pValue());
    result.whole_threshold = sidakThreshold(kRegionSignificance, static_cast<double>(like.channels));
    for (const Difference& channel : whole)
        result.smallest_whole_p = std::min(result.smallest_whole_p, channel.pValue());
    return result;
}

}  // namespace licht
