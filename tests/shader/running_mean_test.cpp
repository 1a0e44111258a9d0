// The history's running mean against double precision, and that it does not stall where fp32 does.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "kernel.h"
#include "licht/core/math.h"
#include "licht/spirv/running_mean_comp.h"

namespace licht {
namespace {

constexpr double kUnit = 0x1p-24;  // relative error of one fp32 rounding

struct Push {
    std::uint32_t threads;
    std::uint32_t count;
    std::uint32_t count_before;
    std::uint32_t stride;
    vec4 mean_before;
};

double sum(const std::vector<vec4>& answers, std::size_t i, int c) {
    return static_cast<double>(answers[i][c]) + static_cast<double>(answers[i + 1][c]);
}

TEST(RunningMean, followsDoublePrecision) {
    constexpr std::uint32_t kThreads = 64;
    constexpr std::uint32_t kCount = 4096;
    std::mt19937 random(1);
    // exp(3 x) of a normal x: a mean of 90 whose standard deviation is 8100, as of fireflies.
    std::normal_distribution<float> normal(0.0F, 3.0F);
    std::vector<vec4> values(std::size_t{kThreads} * kCount);
    for (vec4& value : values)
        for (int c = 0; c < 4; ++c) value[c] = std::exp(normal(random));
    test::Kernel kernel("running mean", running_mean_comp);
    const auto answers = kernel.run<vec4>(kThreads, std::size_t{5} * kThreads,
                                          Push{kThreads, kCount, 0, kThreads, vec4(0.0F)}, values);
    double worst_mean = 0.0;
    double worst_naive = 0.0;
    for (std::uint32_t i = 0; i < kThreads; ++i) {
        for (int c = 0; c < 4; ++c) {
            double mean = 0.0;
            double squares = 0.0;
            double way = 0.0;            // sum of |delta|
            double squares_error = 0.0;  // bound
            double mean_error = 0.0;     // bound
            for (std::uint32_t k = 0; k < kCount; ++k) {
                const auto value = static_cast<double>(values[i + std::size_t{k} * kThreads][c]);
                const double delta = value - mean;
                mean += delta / (k + 1.0);
                const double after = value - mean;
                squares += delta * after;
                way += std::abs(delta);
                // A step rounds twice in delta and up to 2.5 ulp in the division, so it adds less than
                // 8 u |delta| / n; the error that is there shrinks by (n - 1) / n.
                mean_error = 8.0 * kUnit * way / (k + 1.0);
                // delta, delta after and their product round five times; both deltas carry the mean's error.
                squares_error +=
                    8.0 * kUnit * std::abs(delta * after) + (std::abs(delta) + std::abs(after)) * mean_error;
            }
            EXPECT_NEAR(sum(answers, 5 * i, c), mean, mean_error);
            EXPECT_NEAR(sum(answers, 5 * i + 2, c), squares, squares_error);
            worst_mean = std::max(worst_mean, std::abs(sum(answers, 5 * i, c) / mean - 1.0));
            worst_naive =
                std::max(worst_naive, std::abs(static_cast<double>(answers[5 * i + 4][c]) / mean - 1.0));
        }
    }
    RecordProperty("worst_mean", std::to_string(worst_mean / kUnit));
    RecordProperty("worst_naive", std::to_string(worst_naive / kUnit));
}

TEST(RunningMean, doesNotStall) {
    constexpr std::uint32_t kBefore = 1U << 26U;
    constexpr std::uint32_t kCount = 60'000;  // a driver may end loops that take 65,536 turns
    const float value = 1.001F;
    test::Kernel kernel("running mean", running_mean_comp);
    const auto answers =
        kernel.run<vec4>(1, 5, Push{1, kCount, kBefore, 0, vec4(1.0F)}, std::vector<vec4>{vec4(value)});
    // All steps together move the mean by this, and each is right to 8 u, one of them for the count as a
    // float.
    const double way = (static_cast<double>(value) - 1.0) * kCount / (kBefore + static_cast<double>(kCount));
    EXPECT_GT(way, 4.0 * kUnit) << "fp32 could show it";
    const double error = 9.0 * kUnit * way;
    EXPECT_LT(error, 1e-12);
    EXPECT_NEAR(sum(answers, 0, 0), 1.0 + way, error);
    EXPECT_EQ(answers[4].x, 1.0F) << "a plain fp32 mean does not move: a step is below half its ulp";
}

}  // namespace
}  // namespace licht
