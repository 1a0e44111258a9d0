#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "licht/measure/chi2.h"
#include "licht/measure/metrics.h"
#include "licht/measure/statistics.h"
#include "licht/measure/ztest.h"

namespace licht {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

Image filled(int width, int height, int channels, float value) {
    Image image(width, height, channels);
    image.texels.assign(image.texels.size(), value);
    return image;
}

TEST(RunningStatistics, AgreesWithTheDefinition) {
    RunningStatistics statistics;
    EXPECT_EQ(statistics.varianceOfMean(), 0.0);
    for (const double value : {2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0}) statistics.add(value);
    EXPECT_EQ(statistics.count(), 8U);
    EXPECT_DOUBLE_EQ(statistics.mean(), 5.0);
    EXPECT_DOUBLE_EQ(statistics.variance(), 32.0 / 7.0);
    EXPECT_DOUBLE_EQ(statistics.varianceOfMean(), 32.0 / 56.0);
}

TEST(RunningStatistics, DoesNotCancelFarFromZero) {
    // The sum of squares would lose all digits here: 1e9 squared has an ulp of 128, the variance is 1.
    RunningStatistics statistics;
    for (int i = 0; i < 1000; ++i) statistics.add(1e9 + (i % 2 == 0 ? 1.0 : -1.0));
    // Each step rounds to an ulp of the mean (1.2e-7) times a distance of 1; a thousand of them over 999.
    EXPECT_NEAR(statistics.variance(), 1000.0 / 999.0, 4.0 * 1.2e-7);
}

TEST(Metrics, HandMadeImages) {
    Image reference(2, 1, 1);
    reference.texels = {1.0F, 3.0F};
    Image test(2, 1, 1);
    test.texels = {2.0F, 3.0F};
    EXPECT_DOUBLE_EQ(mse(test, reference), 0.5);
    // m = 2: half of 1 / (1 + 0.01 * 4).
    EXPECT_DOUBLE_EQ(relMse(test, reference), 0.5 / 1.04);
    EXPECT_EQ(relMse(reference, reference), 0.0);
}

TEST(Metrics, RelMseIgnoresTheExposureAndKnowsBlack) {
    Image reference(1, 2, 3);
    reference.texels = {1.0F, 2.0F, 3.0F, 0.0F, 0.5F, 4.0F};
    Image test(1, 2, 3);
    test.texels = {1.5F, 2.0F, 2.0F, 0.25F, 1.0F, 4.0F};
    const double error = relMse(test, reference);
    for (Image* image : {&reference, &test})
        for (float& value : image->texels) value *= 1024.0F;
    EXPECT_DOUBLE_EQ(relMse(test, reference), error);

    const Image black = filled(2, 2, 3, 0.0F);
    EXPECT_EQ(relMse(black, black), 0.0);
    EXPECT_EQ(relMse(filled(2, 2, 3, 1e-3F), black), kInfinite);
}

TEST(Metrics, OneRelativeSquareForAll) {
    EXPECT_DOUBLE_EQ(relativeSquare(3.0, 2.0, 10.0), 3.0 / (4.0 + 1.0));
    EXPECT_EQ(relativeSquare(0.0, 0.0, 0.0), 0.0);
    EXPECT_EQ(relativeSquare(1.0, 0.0, 0.0), kInfinite);
}

TEST(Metrics, TrimmedLeavesOutTheWorstThousandth) {
    // 2500 pixels: the worst two are left out. Every pixel of the reference is 1 in each channel, so a
    // difference d adds d^2 / 1.01 to a third of its pixel.
    const Image reference = filled(50, 50, 3, 1.0F);
    Image test = reference;
    test.at(3, 4, 0) = 1001.0F;
    test.at(7, 8, 2) = 101.0F;
    test.at(49, 49, 1) = 3.0F;
    test.at(49, 49, 2) = 2.0F;
    EXPECT_DOUBLE_EQ(trimmedRelMse(test, reference), 5.0 / 3.0 / 1.01 / 2498.0);
    EXPECT_DOUBLE_EQ(relMse(test, reference), (1e6 + 1e4 + 5.0) / 3.0 / 1.01 / 2500.0);
    // Below a thousand pixels nothing is left out.
    Image small = filled(9, 111, 1, 1.0F);
    const Image small_reference = small;
    small.at(0, 0, 0) = 2.0F;
    EXPECT_DOUBLE_EQ(trimmedRelMse(small, small_reference), 1.0 / 1.01 / 999.0);
}

TEST(Metrics, LargestDifferenceAndMeans) {
    Image reference(2, 1, 2);
    reference.texels = {1.0F, -3.0F, 2.0F, 4.0F};
    Image test(2, 1, 2);
    test.texels = {1.5F, -3.0F, 2.0F, 2.0F};
    EXPECT_DOUBLE_EQ(largestDifference(test, reference), 2.0);
    EXPECT_EQ(channelMeans(test), (std::vector<double>{1.75, -0.5}));
}

/// A picture of normal noise around a gradient: mean and variance of the mean, of known sigma.
struct Noisy {
    Image mean;
    Image variance;
    [[nodiscard]] Estimate estimate() const { return {mean, variance}; }
};

constexpr int kWidth = 100;
constexpr int kHeight = 70;
constexpr float kSigma = 0.05F;

Noisy noisy(unsigned seed) {
    Noisy result{Image(kWidth, kHeight, 3), filled(kWidth, kHeight, 3, kSigma * kSigma)};
    std::mt19937 random(seed);
    std::normal_distribution<float> noise(0.0F, kSigma);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            for (int c = 0; c < 3; ++c)
                result.mean.at(x, y, c) = 1.0F + 0.01F * static_cast<float>(x) + noise(random);
    return result;
}

TEST(ZTest, SidakThreshold) {
    EXPECT_DOUBLE_EQ(sidakThreshold(0.01, 1.0), 0.01);
    EXPECT_NEAR(1.0 - std::pow(1.0 - sidakThreshold(0.01, 1000.0), 1000.0), 0.01, 1e-12);
}

TEST(ZTest, PValueOfOnePixel) {
    // z = 1.959964: the two-sided 5 % point of the normal distribution; its slope there, 2 phi(z) = 0.117,
    // times the float rounding of z (2.4e-7) bounds the error.
    const Image a = filled(1, 1, 1, 1.959964F * 5.0F);
    const Image b = filled(1, 1, 1, 0.0F);
    const Image variance_a = filled(1, 1, 1, 9.0F);
    const Image variance_b = filled(1, 1, 1, 16.0F);
    EXPECT_NEAR(zTest({a, variance_a}, {b, variance_b}).smallest_p, 0.05, 1e-7);
}

TEST(ZTest, SameMeanPasses) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        const ZTestResult result = zTest(noisy(2 * seed).estimate(), noisy(2 * seed + 1).estimate());
        // Twenty right pictures at a significance of 0.01, with fixed seeds.
        EXPECT_TRUE(result.passed()) << seed << ": " << result.pass_share << " " << result.smallest_block_p
                                     << " " << result.smallest_whole_p;
    }
}

TEST(ZTest, PValuesOfEqualMeansAreUniform) {
    const ZTestResult result = zTest(noisy(1).estimate(), noisy(2).estimate());
    std::vector<std::uint64_t> counts(20);
    for (const float p : result.p_values.texels)
        ++counts[std::min<std::size_t>(19, static_cast<std::size_t>(p * 20.0F))];
    const std::vector<double> expected(20, static_cast<double>(result.p_values.texels.size()) / 20.0);
    EXPECT_GT(chiSquareTest(counts, expected).p, 0.001);
}

TEST(ZTest, BiasedRegionFails) {
    const Noisy a = noisy(1);
    Noisy b = noisy(2);
    // Five sigma of the difference on 12 x 12 of 7000 pixels. 57 % of them fall below the per-pixel threshold
    // (z = 4.8), more than the 17 that may.
    for (int y = 20; y < 32; ++y)
        for (int x = 40; x < 52; ++x)
            for (int c = 0; c < 3; ++c) b.mean.at(x, y, c) += 5.0F * std::sqrt(2.0F) * kSigma;
    const ZTestResult result = zTest(a.estimate(), b.estimate());
    EXPECT_FALSE(result.passed());
    EXPECT_LT(result.pass_share, ZTestResult::kWantedShare);
    EXPECT_LT(result.smallest_block_p, result.block_threshold);
}

TEST(ZTest, SmallUniformBiasPassesPerPixelButFailsInBlocks) {
    const Noisy a = noisy(1);
    Noisy b = noisy(2);
    // Half a sigma is 0.35 sigma of the difference: 5.7 sigma of a block of 256 pixels, 30 sigma of the
    // picture.
    for (float& value : b.mean.texels) value += 0.5F * kSigma;
    const ZTestResult result = zTest(a.estimate(), b.estimate());
    EXPECT_GE(result.pass_share, ZTestResult::kWantedShare);
    EXPECT_LT(result.smallest_block_p, result.block_threshold);
    EXPECT_LT(result.smallest_whole_p, result.whole_threshold);
    EXPECT_FALSE(result.passed());
}

TEST(ZTest, TinyUniformBiasFailsOnTheWholePicture) {
    const Noisy a = noisy(1);
    Noisy b = noisy(2);
    // A tenth of a sigma of one pixel: 5.9 sigma of the mean of 7000 differences.
    for (float& value : b.mean.texels) value += 0.1F * kSigma;
    const ZTestResult result = zTest(a.estimate(), b.estimate());
    EXPECT_LT(result.smallest_whole_p, result.whole_threshold);
    EXPECT_FALSE(result.passed());
}

TEST(ZTest, WithoutVarianceOnlyEqualValuesPass) {
    const Image none = filled(20, 20, 3, 0.0F);
    const Image a = filled(20, 20, 3, 0.75F);
    EXPECT_TRUE(zTest({a, none}, {a, none}).passed());
    // Within four units in the last place (relative 4.8e-7).
    EXPECT_TRUE(zTest({a, none}, {filled(20, 20, 3, 0.75F + 2.4e-7F), none}).passed());
    const ZTestResult different = zTest({a, none}, {filled(20, 20, 3, 0.75F + 1e-6F), none});
    EXPECT_FALSE(different.passed());
    EXPECT_EQ(different.smallest_p, 0.0);
    EXPECT_EQ(different.pass_share, 0.0);
}

TEST(ZTest, NonFiniteValuesFail) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinite = std::numeric_limits<float>::infinity();
    const Noisy good = noisy(1);
    for (const float bad_value : {nan, infinite}) {
        Noisy bad = noisy(2);
        bad.mean.at(3, 4, 1) = bad_value;
        EXPECT_FALSE(zTest(good.estimate(), bad.estimate()).passed());
        bad = noisy(2);
        bad.variance.at(3, 4, 1) = bad_value;
        EXPECT_FALSE(zTest(good.estimate(), bad.estimate()).passed());
    }
    Noisy negative = noisy(2);
    negative.variance.at(0, 0, 0) = -1.0F;
    EXPECT_FALSE(zTest(good.estimate(), negative.estimate()).passed());
}

TEST(ChiSquare, IncompleteGammaOfKnownValues) {
    // Q(1, x) = e^-x and Q(1/2, x) = erfc(sqrt(x)), on both sides of x = a + 1. Relative tolerance: the
    // exponent reaches 50, so its rounding of one part in 4.5e15 becomes 50 parts; a factor of ten for the
    // sums.
    for (const double x : {1e-6, 0.1, 0.9, 1.4, 1.6, 2.1, 5.0, 20.0, 50.0}) {
        EXPECT_NEAR(upperIncompleteGamma(1.0, x), std::exp(-x),
                    1e-13 * std::max(std::exp(-x), x < 2.0 ? 1.0 : 0.0));
        EXPECT_NEAR(upperIncompleteGamma(0.5, x), std::erfc(std::sqrt(x)),
                    1e-13 * std::max(std::erfc(std::sqrt(x)), x < 1.5 ? 1.0 : 0.0));
    }
    // Integer a: Q(a, x) = e^-x sum of x^k / k! for k < a.
    double term = std::exp(-90.0);
    double sum = term;
    for (int k = 1; k < 100; ++k) sum += term *= 90.0 / k;
    EXPECT_NEAR(upperIncompleteGamma(100.0, 90.0), sum, 1e-12);
    EXPECT_EQ(upperIncompleteGamma(3.0, 0.0), 1.0);
    EXPECT_EQ(upperIncompleteGamma(3.0, kInfinite), 0.0);
}

TEST(ChiSquare, PercentagePointsOfTheTables) {
    // Abramowitz and Stegun, table 26.8: the 5 % points, to the digits printed (half a unit of the last digit
    // times the slope).
    EXPECT_NEAR(upperIncompleteGamma(0.5, 0.5 * 3.84146), 0.05, 1e-6);
    EXPECT_NEAR(upperIncompleteGamma(5.0, 0.5 * 18.3070), 0.05, 1e-5);
    EXPECT_NEAR(upperIncompleteGamma(50.0, 0.5 * 124.342), 0.05, 1e-5);
}

std::vector<std::uint64_t> sampled(const std::vector<double>& weights, int count, unsigned seed) {
    std::mt19937 random(seed);
    std::discrete_distribution<std::size_t> cell(weights.begin(), weights.end());
    std::vector<std::uint64_t> counts(weights.size());
    for (int i = 0; i < count; ++i) ++counts[cell(random)];
    return counts;
}

TEST(ChiSquare, AcceptsUniformAndRejectsSlightBias) {
    constexpr int count = 1000000;
    std::vector<double> weights(64, 1.0);
    const std::vector<double> expected(64, count / 64.0);
    const ChiSquareResult fair = chiSquareTest(sampled(weights, count, 1), expected);
    EXPECT_EQ(fair.degrees, 63U);
    EXPECT_GT(fair.p, 0.001);
    // Half of the cells 3 % likelier, so each is off by 1.5 %: the statistic becomes 63 + count * 0.015^2 =
    // 285 with a standard deviation of sqrt(2 (63 + 2 * 222)) = 32 (noncentral chi-square); p = 1e-4 is at
    // 116, five of them below.
    for (std::size_t i = 0; i < 32; ++i) weights[i] = 1.03;
    EXPECT_LT(chiSquareTest(sampled(weights, count, 1), expected).p, 1e-4);
}

TEST(ChiSquare, StatisticAndPooling) {
    // Two cells of 4 and 3 are pooled into one of 7.
    const std::vector<std::uint64_t> observed = {4, 12, 5, 9};
    const std::vector<double> expected = {4.0, 10.0, 3.0, 13.0};
    const ChiSquareResult result = chiSquareTest(observed, expected);
    EXPECT_EQ(result.degrees, 2U);
    EXPECT_DOUBLE_EQ(result.statistic, 4.0 / 10.0 + 16.0 / 13.0 + 4.0 / 7.0);
    // Two degrees of freedom: the p-value is e^(-statistic / 2).
    EXPECT_NEAR(result.p, std::exp(-0.5 * result.statistic), 1e-14);
}

TEST(ChiSquare, SmallPoolTakesTheNextCell) {
    const std::vector<std::uint64_t> observed = {1, 7, 12};
    const std::vector<double> expected = {1.0, 8.0, 11.0};
    const ChiSquareResult result = chiSquareTest(observed, expected);
    EXPECT_EQ(result.degrees, 1U);
    EXPECT_DOUBLE_EQ(result.statistic, 1.0 / 9.0 + 1.0 / 11.0);
}

TEST(ChiSquare, CountWhereNoneMayBeFails) {
    const std::vector<std::uint64_t> observed = {1, 99, 100};
    EXPECT_EQ(chiSquareTest(observed, std::vector<double>{0.0, 100.0, 100.0}).p, 0.0);
    const std::vector<std::uint64_t> none = {0, 99, 101};
    EXPECT_GT(chiSquareTest(none, std::vector<double>{0.0, 100.0, 100.0}).p, 0.5);
}

}  // namespace
}  // namespace licht
