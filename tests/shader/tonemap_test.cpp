// The curves from scene light to display light over everything that fp32 can hold.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>
#include <vector>

#include "kernel.h"
#include "licht/colour/transfer.h"
#include "licht/core/math.h"
#include "licht/settings/settings.h"
#include "licht/shared/choices.h"
#include "licht/spirv/tonemap_comp.h"

namespace licht {
namespace {

constexpr double kUnit = 0x1p-24;  // relative error of one fp32 rounding
constexpr std::uint32_t kLargestFinite = 0x7f7fffffU;
constexpr uint kCurves[] = {kTonemapNone, kTonemapNeutral, kTonemapAgx, kTonemapAces};

struct Push {
    std::uint32_t count;
    std::uint32_t curve;
};

/// Grey of ascending brightness, evenly spread over the bit patterns of finite non-negative floats.
std::vector<vec4> greySweep(std::uint32_t count) {
    std::vector<vec4> colors;
    for (std::uint32_t i = 0; i < count; ++i)
        colors.emplace_back(std::bit_cast<float>(
            static_cast<std::uint32_t>(std::uint64_t{kLargestFinite} * i / (count - 1))));
    return colors;
}

std::vector<vec4> mixedColors(std::uint32_t count) {
    std::mt19937 random(1);
    std::uniform_int_distribution<std::uint32_t> any(0, kLargestFinite);
    std::uniform_real_distribution<float> common(0.0F, 4.0F);
    std::vector<vec4> colors;
    for (std::uint32_t i = 0; i < count; ++i)
        colors.push_back(i % 2 == 0
                             ? vec4(std::bit_cast<float>(any(random)), std::bit_cast<float>(any(random)),
                                    std::bit_cast<float>(any(random)), 0.0F)
                             : vec4(common(random), common(random), common(random), 0.0F));
    for (int c = 0; c < 3; ++c) {  // pure primaries, as bright as can be
        vec4 primary(0.0F);
        primary[c] = std::bit_cast<float>(kLargestFinite);
        colors.push_back(primary);
    }
    return colors;
}

/// Display light and encoded value per colour.
std::vector<vec4> mapped(const std::vector<vec4>& colors, uint curve) {
    test::Kernel kernel("tonemap", tonemap_comp);
    const auto count = static_cast<std::uint32_t>(colors.size());
    return kernel.run<vec4>(count, 2 * colors.size(), Push{count, curve}, colors);
}

TEST(Tonemap, everyFiniteColourGivesADisplayColour) {
    std::vector<vec4> colors = greySweep(1U << 20U);
    const std::vector<vec4> mixed = mixedColors(1U << 18U);
    colors.insert(colors.end(), mixed.begin(), mixed.end());
    for (const uint curve : kCurves) {
        const std::vector<vec4> answers = mapped(colors, curve);
        double worst = 0.0;
        for (std::size_t i = 0; i < colors.size(); ++i) {
            for (int c = 0; c < 3; ++c) {
                const float light = answers[2 * i][c];
                const float encoded = answers[2 * i + 1][c];
                ASSERT_TRUE(std::isfinite(light)) << curve << ": " << colors[i][c];
                ASSERT_TRUE(encoded >= 0.0F && encoded <= 1.0F)
                    << curve << ": " << colors[i][c] << " " << encoded;
                const float expected = srgbFromLinear(std::clamp(light, 0.0F, 1.0F));
                worst = std::max(worst, static_cast<double>(std::abs(encoded - expected)));
            }
        }
        // A 64th of a step of the 8 bits that are shown.
        EXPECT_LT(worst, 1.0 / 255.0 / 64.0) << curve;
        RecordProperty("encoding_error_" + std::to_string(curve), std::to_string(worst * 255.0));
    }
}

TEST(Tonemap, blackStaysBlackAndBrightLightIsWhite) {
    const std::vector<vec4> colors{vec4(0.0F), vec4(1e30F)};
    for (const uint curve : kCurves) {
        const std::vector<vec4> answers = mapped(colors, curve);
        for (int c = 0; c < 3; ++c) {
            // Half a step of 8 bits.
            EXPECT_LT(answers[1][c], 0.5F / 255.0F) << curve;
            EXPECT_GT(answers[3][c], 1.0F - 0.5F / 255.0F) << curve;
        }
    }
}

TEST(Tonemap, neutralKeepsBaseColours) {
    // Its definition for grey: 6.25 x^2 below 0.08, x - 0.04 up to 0.8, compressed beyond.
    std::vector<vec4> colors;
    for (int i = 0; i <= 4000; ++i) colors.emplace_back(static_cast<float>(i) / 4000.0F);
    const std::vector<vec4> answers = mapped(colors, kTonemapNeutral);
    for (std::size_t i = 0; i < colors.size(); ++i) {
        const auto x = static_cast<double>(colors[i].x);
        const auto y = static_cast<double>(answers[2 * i].x);
        // Constants and three operations round, each by u of values below one.
        const double tolerance = 8.0 * kUnit;
        if (x < 0.8) {
            EXPECT_NEAR(y, x < 0.08 ? 6.25 * x * x : x - 0.04, tolerance) << x;
        } else if (x > 0.801) {
            EXPECT_LT(y, x - 0.04);
        }
        EXPECT_EQ(answers[2 * i].x, answers[2 * i].y);
        EXPECT_EQ(answers[2 * i].x, answers[2 * i].z);
    }
}

TEST(Tonemap, neutralNeverDarkensWithMoreLight) {
    const std::vector<vec4> answers = mapped(greySweep(1U << 20U), kTonemapNeutral);
    for (std::size_t i = 2; i < answers.size(); i += 2) {
        // The compressed value takes eight operations below one.
        ASSERT_GE(static_cast<double>(answers[i].x), static_cast<double>(answers[i - 2].x) - 8.0 * kUnit)
            << i / 2;
    }
}

TEST(Tonemap, acesAndAgxFollowTheirDefinitionForGrey) {
    std::vector<vec4> colors;
    for (int i = -60; i <= 40; ++i) colors.emplace_back(std::exp2(static_cast<float>(i) * 0.25F));
    const std::vector<vec4> aces = mapped(colors, kTonemapAces);
    const std::vector<vec4> agx = mapped(colors, kTonemapAgx);
    for (std::size_t i = 0; i < colors.size(); ++i) {
        const auto x = static_cast<double>(colors[i].x);
        // The rows of Hill's matrices sum to one within 2e-5, so grey passes the rational curve alone.
        const double y = (x * (x + 0.0245786) - 0.000090537) / (x * (0.983729 * x + 0.4329510) + 0.238081);
        const double t = (std::clamp(std::log2(x), -12.47393, 4.026069) + 12.47393) / (12.47393 + 4.026069);
        const double curve = 15.5 * std::pow(t, 6) - 40.14 * std::pow(t, 5) + 31.96 * std::pow(t, 4) -
                             6.868 * std::pow(t, 3) + 0.4298 * t * t + 0.1191 * t - 0.00232;
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(static_cast<double>(aces[2 * i][c]), y, 1e-4) << x;
            // The rows of Wrensch's matrices sum to one within 2e-4 each; the curve's slope (below 0.2 for a
            // factor e) and the power 2.2 make of both at most 2.2 * (0.2 + 1) * 2e-4.
            EXPECT_NEAR(static_cast<double>(agx[2 * i][c]), std::pow(std::max(curve, 0.0), 2.2), 6e-4) << x;
        }
    }
}

}  // namespace
}  // namespace licht
