// Sampling of environment maps on the device, against their tables and the radiance that the maps stand for.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "histogram.h"
#include "kernel.h"
#include "licht/colour/transfer.h"
#include "licht/gpu/upload_image.h"
#include "licht/light/environment_table.h"
#include "licht/settings/settings.h"
#include "licht/shared/choices.h"
#include "licht/shared/constants.h"
#include "licht/shared/frame.h"
#include "licht/shared/light.h"
#include "licht/spirv/environment_comp.h"

namespace licht {
namespace {

using glm::dvec3;

constexpr double kPi = std::numbers::pi;
constexpr double kUnit = 0x1p-24;  // relative error of one fp32 rounding
constexpr std::uint32_t kCount = 1U << 19U;
// How well directions find their place on the map, as latlong_test shows.
constexpr double kErrorU = 1e-6;
constexpr double kErrorV = 2e-6;

double d(float x) {
    return static_cast<double>(x);
}

Environment filled(const std::string& name, int width, int height, float value) {
    Environment environment{name, Image(width, height, 3)};
    environment.radiance.texels.assign(environment.radiance.texels.size(), value);
    return environment;
}

void set(Environment& environment, int x, int y, float value) {
    for (int c = 0; c < 3; ++c) environment.radiance.at(x, y, c) = value;
}

std::vector<Environment> environments() {
    std::vector<Environment> all;
    all.push_back(filled("constant", 16, 8, 2.0F));
    all.push_back(filled("one texel", 1, 1, 3.0F));
    all.push_back(filled("one row", 8, 1, 1.0F));
    Environment gradient = filled("gradient", 32, 16, 0.0F);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 32; ++x)
            set(gradient, x, y, 0.1F + static_cast<float>(x) + 2.0F * static_cast<float>(y));
    all.push_back(gradient);
    Environment sun = filled("sun", 64, 32, 0.01F);
    set(sun, 63, 9, 1e4F);  // beside the seam
    all.push_back(sun);
    Environment black_rows = filled("black rows", 16, 16, 0.0F);
    for (int x = 0; x < 16; ++x)
        for (const int y : {0, 5, 6, 15}) set(black_rows, x, y, 1.0F + static_cast<float>(x % 3));
    all.push_back(black_rows);
    Environment odd = filled("odd sides", 13, 7, 0.0F);
    std::mt19937 random(1);
    std::exponential_distribution<float> value(1.0F);
    for (int y = 0; y < 7; ++y)
        for (int x = 0; x < 13; ++x) set(odd, x, y, value(random));
    all.push_back(odd);
    Environment turned = odd;
    turned.name = "turned";
    turned.turn = 0.3F;
    all.push_back(turned);
    return all;
}
Environment singleTexel(float value) {
    Environment environment = filled("single texel", 64, 32, 0.0F);
    set(environment, 20, 10, value);
    return environment;
}

constexpr std::array kMethods{EnvironmentSampling::alias, EnvironmentSampling::inversion,
                              EnvironmentSampling::rejection};
constexpr int kTests = 3 * 8;  // chi-square tests in this file: one a method and environment

struct Answer {
    vec4 direction_pdf;
    vec4 radiance_pdf;  // looked up
    vec4 tries;
};

struct Push {
    std::uint32_t count;
    std::uint32_t given;
};

/// Place on the map, (u, v) in [0,1]^2, and how far apart directions may be found there: rounding a component
/// by u turns a direction near a pole by u / sin(theta).
struct Place {
    double u;
    double v;
    double error_u;
};
Place placeOf(const Environment& environment, const dvec3& w) {
    const double horizontal = std::hypot(w.x, w.z);
    // A map turned to the left shows what was to the right.
    const double u = 0.5 + std::atan2(w.x, -w.z) / (2.0 * kPi) + d(environment.turn);
    return {u > 1.0 ? u - 1.0 : u, std::atan2(horizontal, w.y) / kPi,
            kErrorU + 4.0 * kUnit / std::max(horizontal, 1e-30)};
}

std::string nameOf(EnvironmentSampling how) {
    return how == EnvironmentSampling::alias       ? "alias"
           : how == EnvironmentSampling::inversion ? "inversion"
                                                   : "rejection";
}

EnvironmentTable tableOf(const Environment& environment, EnvironmentSampling how) {
    return buildEnvironmentTable(environmentShares(environment), environment.radiance.width, how);
}

class OnDevice {
public:
    /// sampler: kSampler...
    OnDevice(const Environment& environment, EnvironmentSampling how, std::uint32_t sampler = kSamplerRandom)
        : kernel_("environment", environment_comp,
                  {{kConstantEnvironmentSampling, static_cast<std::uint32_t>(how)},
                   {kConstantSampler, sampler},
                   {kConstantBlueBits, 0U}}),
          nearest_(gpu::testDevice(), VK_FILTER_NEAREST, VK_SAMPLER_ADDRESS_MODE_REPEAT,
                   VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE) {
        gpu::Device& device = gpu::testDevice();
        const Image& map = environment.radiance;
        const EnvironmentTable table = tableOf(environment, how);
        FrameRecord frame{};
        frame.environment_size = uvec2(map.width, map.height);
        frame.environment_peak = table.peak;
        frame.environment_turn = environment.turn;
        frame.seed = 7;
        frame_ = gpu::uploadBuffer(device, "FrameBlock", std::span<const FrameRecord>(&frame, 1),
                                   VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
        std::vector<vec4> texels;
        for (std::size_t i = 0; i < map.texels.size(); i += 3)
            texels.emplace_back(map.texels[i], map.texels[i + 1], map.texels[i + 2], 0.0F);
        map_ = gpu::uploadImage(
            device, "environment_map", {frame.environment_size.x, frame.environment_size.y},
            VK_FORMAT_R32G32B32A32_SFLOAT, std::as_bytes(std::span(texels)), VK_IMAGE_USAGE_SAMPLED_BIT);
        table_ = gpu::uploadImage(device, "environment_table", {table.size.x, table.size.y},
                                  table.words == 4 ? VK_FORMAT_R32G32B32A32_UINT : VK_FORMAT_R32_UINT,
                                  std::as_bytes(std::span(table.texels)), VK_IMAGE_USAGE_SAMPLED_BIT);
    }

    std::vector<Answer> sample() { return run({kCount, 0}, {vec4(0.0F)}); }
    std::vector<Answer> lookUp(const std::vector<vec4>& directions) {
        return run({static_cast<std::uint32_t>(directions.size()), 1}, directions);
    }

private:
    std::vector<Answer> run(const Push& push, const std::vector<vec4>& directions) {
        return kernel_.run<Answer>(push.count, push.count, push, directions,
                                   {{"FrameBlock", &frame_},
                                    {"environment_table", gpu::SampledImage{&table_, &nearest_}},
                                    {"environment_map", gpu::SampledImage{&map_, &nearest_}}});
    }

    test::Kernel kernel_;
    gpu::Buffer frame_;
    gpu::Image map_;
    gpu::Image table_;
    gpu::Sampler nearest_;
};

/// Bilinear, as the shader interpolates; x and y in texels.
double radiance(const Image& map, double x, double y) {
    const double left = std::floor(x - 0.5);
    const double top = std::floor(y - 0.5);
    double sum = 0.0;
    for (int j = 0; j < 2; ++j) {
        for (int i = 0; i < 2; ++i) {
            const int column = (static_cast<int>(left) + i + map.width) % map.width;
            const int row = std::clamp(static_cast<int>(top) + j, 0, map.height - 1);
            const double weight = (1.0 - std::abs(x - 0.5 - left - i)) * (1.0 - std::abs(y - 0.5 - top - j));
            sum += weight *
                   d(luminance(vec3(map.at(column, row, 0), map.at(column, row, 1), map.at(column, row, 2))));
        }
    }
    return sum;
}

double solidAngle(std::size_t row, double width, double height) {
    return 4.0 * kPi / width * std::sin(kPi * (static_cast<double>(row) + 0.5) / height) *
           std::sin(0.5 * kPi / height);
}

TEST(EnvironmentTable, followsTheRadiance) {
    for (const Environment& environment : environments()) {
        const Image& map = environment.radiance;
        std::vector<double> power;
        double total = 0.0;
        for (int y = 0; y < map.height; ++y) {
            for (int x = 0; x < map.width; ++x) {
                // The interpolant bends in the middle of a texel alone, so the midpoint rule in quarters is
                // exact.
                double sum = 0.0;
                for (int j = 0; j < 4; ++j)
                    for (int i = 0; i < 4; ++i)
                        sum += radiance(map, x + (i + 0.5) / 4.0, y + (j + 0.5) / 4.0) / 16.0;
                power.push_back(sum *
                                (std::cos(kPi * y / map.height) - std::cos(kPi * (y + 1) / map.height)));
                total += power.back();
            }
        }
        const std::vector<double> shares = environmentShares(environment);
        ASSERT_EQ(shares.size(), power.size());
        // Luminance in fp32 rounds three products and two sums.
        for (std::size_t i = 0; i < power.size(); ++i)
            EXPECT_NEAR(shares[i], power[i] / total, 8.0 * kUnit * power[i] / total)
                << environment.name << " " << i;
    }
}

/// What a table makes of the shares.
std::vector<double> tableShares(const EnvironmentTable& table, std::size_t width, std::size_t height) {
    std::vector<double> shares;
    for (std::size_t i = 0; i < width * height; ++i) {
        if (table.words == 4) {
            shares.push_back(d(std::bit_cast<float>(table.texels[4 * i + 2])));
            continue;
        }
        const std::size_t at = i + i / width;  // a column more
        const std::size_t row = (i / width) * (width + 1) + width;
        const uint column = table.texels[at] - (i % width > 0 ? table.texels[at - 1] : 0U);
        const uint rows = table.texels[row] - (row > width ? table.texels[row - width - 1] : 0U);
        shares.push_back(std::ldexp(std::ldexp(static_cast<double>(column) * rows, -31), -31));
    }
    return shares;
}

// A constant map as large as maps are: sums in fp32 would stop at 16,777,216 texels, and the shares follow
// the solid angle alone.
TEST(EnvironmentTable, constantMapIsTheSolidAngle) {
    constexpr std::size_t kWidth = 4200;
    constexpr std::size_t kHeight = 4000;
    const Environment environment = filled("constant", kWidth, kHeight, 1.0F);
    const EnvironmentTable alias = tableOf(environment, EnvironmentSampling::alias);
    const EnvironmentTable ends = tableOf(environment, EnvironmentSampling::inversion);
    EXPECT_NEAR(d(alias.peak), 0.25 / kPi, 1e-6);
    EXPECT_EQ(alias.peak, ends.peak);
    const std::vector<double> by_alias = tableShares(alias, kWidth, kHeight);
    const std::vector<double> by_ends = tableShares(ends, kWidth, kHeight);
    double alias_sum = 0.0;
    double ends_sum = 0.0;
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < by_alias.size(); ++i) {
        const double share = solidAngle(i / kWidth, kWidth, kHeight) / (4.0 * kPi);
        alias_sum += by_alias[i];
        ends_sum += by_ends[i];
        if (!(std::abs(by_alias[i] - share) <= 1e-6 * share)) ++wrong;
        // An end is rounded to a unit of its row, and that to one of the whole.
        const double row = share * kWidth;
        if (!(std::abs(by_ends[i] - share) <= 0x1p-30 * row + 0x1p-30 / kWidth)) ++wrong;
    }
    EXPECT_EQ(wrong, 0U);
    EXPECT_NEAR(alias_sum, 1.0, 1e-6);
    EXPECT_NEAR(ends_sum, 1.0, 1e-12);
}

TEST(EnvironmentTable, blackMapsHaveNoShares) {
    const Environment black = filled("black", 16, 8, 0.0F);
    for (const EnvironmentSampling how : kMethods) {
        const EnvironmentTable table = tableOf(black, how);
        EXPECT_EQ(table.peak, 0.0F);
        for (const double share : tableShares(table, 16, 8)) ASSERT_EQ(share, 0.0) << nameOf(how);
        for (const Answer& answer : OnDevice(black, how).sample()) {
            ASSERT_EQ(answer.direction_pdf.w, 0.0F) << nameOf(how);
            ASSERT_EQ(answer.radiance_pdf, vec4(0.0F)) << nameOf(how);
        }
    }
}

// What shines can be found, however dark it is beside the rest, and nothing else is.
TEST(EnvironmentTable, everyTexelWithLightHasAShare) {
    Environment environment = filled("sun", 256, 128, 1e-12F);
    set(environment, 200, 100, 1e6F);
    set(environment, 7, 0, 0.0F);
    for (const EnvironmentSampling how : {EnvironmentSampling::alias, EnvironmentSampling::inversion})
        for (const double share : tableShares(tableOf(environment, how), 256, 128))
            ASSERT_GT(share, 0.0) << nameOf(how);
    const Environment texel = singleTexel(1.0F);
    const std::vector<double> shares = environmentShares(texel);
    for (const EnvironmentSampling how : kMethods) {
        const std::vector<double> kept =
            tableShares(tableOf(texel, how), static_cast<std::size_t>(texel.radiance.width),
                        shares.size() / static_cast<std::size_t>(texel.radiance.width));
        for (std::size_t i = 0; i < shares.size(); ++i)
            ASSERT_EQ(kept[i] > 0.0, shares[i] > 0.0) << nameOf(how);
    }
}

// Twice as bright above as below: all of the draws go up, and there by solid angle; the two rows that the
// map's interpolation blends are neither.
TEST(SharesAboveMean, areWhatStandsOut) {
    constexpr int kWidth = 64;
    constexpr int kHeight = 32;
    Environment halves = filled("halves", kWidth, kHeight, 1.0F);
    for (int y = 0; y < kHeight / 2; ++y)
        for (int x = 0; x < kWidth; ++x) set(halves, x, y, 2.0F);
    const std::vector<double> shares = sharesAboveMean(halves);
    // The mean is 1.5. The row at the border holds 7/8 * 2 + 1/8: three quarters of what the others have
    // above.
    const double border = kWidth * solidAngle(kHeight / 2 - 1, kWidth, kHeight);
    const double above = 2.0 * kPi - border + 0.75 * border;
    double sum = 0.0;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const std::size_t row = i / kWidth;
        const double angle = solidAngle(row, kWidth, kHeight);
        const double expected = row + 1 < kHeight / 2    ? angle / above
                                : row + 1 == kHeight / 2 ? 0.75 * angle / above
                                                         : 0.0;
        EXPECT_NEAR(shares[i], expected, 1e-12) << row;
        sum += shares[i];
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
}

TEST(SharesAboveMean, areNoneUnderAConstantSky) {
    for (const int width : {1, 7, 256, 4200}) {
        const Environment sky = filled("constant", width, std::max(width / 2, 1), 0.3F);
        for (const double share : sharesAboveMean(sky)) ASSERT_EQ(share, 0.0) << width;
    }
}

class EveryMethod : public testing::TestWithParam<EnvironmentSampling> {};

TEST_P(EveryMethod, directionsFollowTheTable) {
    for (const Environment& environment : environments()) {
        const auto width = static_cast<std::size_t>(environment.radiance.width);
        const auto height = static_cast<std::size_t>(environment.radiance.height);
        OnDevice device(environment, GetParam());
        const std::vector<double> shares = tableShares(tableOf(environment, GetParam()), width, height);
        // Four cells a texel: within it directions are uniform by solid angle.
        std::vector<std::uint64_t> counts(4 * width * height);
        std::vector<double> expected(counts.size());
        for (std::size_t i = 0; i < expected.size(); ++i) expected[i] = 0.25 * kCount * shares[i / 4];
        for (const Answer& answer : device.sample()) {
            const dvec3 w(answer.direction_pdf);
            ASSERT_NEAR(glm::length(w), 1.0, 1e-6);
            const Place place = placeOf(environment, w);
            const double x =
                std::min(place.u * static_cast<double>(width), static_cast<double>(width) - 1e-9);
            const auto row = static_cast<std::size_t>(
                std::min(place.v * static_cast<double>(height), static_cast<double>(height) - 1e-9));
            const double upper = std::cos(kPi * static_cast<double>(row) / static_cast<double>(height));
            const double lower = std::cos(kPi * static_cast<double>(row + 1) / static_cast<double>(height));
            const std::size_t right = x - std::floor(x) >= 0.5 ? 1 : 0;
            const std::size_t below = w.y < 0.5 * (upper + lower) ? 2 : 0;
            ++counts[4 * (row * width + static_cast<std::size_t>(x)) + right + below];
        }
        test::expectLikely(environment.name, counts, expected, kTests);
    }
}

TEST_P(EveryMethod, bothDensitiesAgree) {
    for (const Environment& environment : environments()) {
        const auto width = static_cast<double>(environment.radiance.width);
        const auto height = static_cast<double>(environment.radiance.height);
        OnDevice device(environment, GetParam());
        std::size_t at_edges = 0;
        double inverse = 0.0;
        double inverse2 = 0.0;
        for (const Answer& answer : device.sample()) {
            const double pdf = d(answer.direction_pdf.w);
            ASSERT_GT(pdf, 0.0);
            inverse += 1.0 / pdf;
            inverse2 += 1.0 / (pdf * pdf);
            const Place place = placeOf(environment, dvec3(answer.direction_pdf));
            const double edge_u = std::abs(place.u * width - std::round(place.u * width)) / width;
            const double edge_v = std::abs(place.v * height - std::round(place.v * height)) / height;
            if (edge_u < place.error_u || edge_v < kErrorV) {
                ++at_edges;
                continue;
            }
            ASSERT_EQ(d(answer.radiance_pdf.w), pdf) << environment.name << " " << place.u << " " << place.v;
        }
        // Samples crowd into texels, not to their edges: a strip of a few errors beside every edge, and at
        // the poles where sin(theta) is below the share of a texel, which a thousandth of the samples covers.
        EXPECT_LT(at_edges, kCount / 1000) << environment.name;
        // The mean of 1 / pdf is the solid angle that can be sampled.
        double lit = 0.0;
        const std::vector<double> shares = environmentShares(environment);
        for (std::size_t i = 0; i < shares.size(); ++i)
            if (shares[i] > 0.0)
                lit += solidAngle(i / static_cast<std::size_t>(environment.radiance.width), width, height);
        const double mean = inverse / kCount;
        const double variance = std::max(inverse2 / kCount - mean * mean, 0.0);
        EXPECT_NEAR(mean, lit, 4.5 * std::sqrt(variance / kCount) + 8.0 * kUnit * lit) << environment.name;
    }
}

TEST_P(EveryMethod, densityIntegratesToOneAndRadianceIsBilinear) {
    for (const Environment& environment : environments()) {
        const Image& map = environment.radiance;
        constexpr int kInner = 4;
        std::vector<vec4> directions;
        std::vector<double> areas;
        for (int y = 0; y < map.height; ++y) {
            const double upper = std::cos(kPi * y / map.height);
            const double lower = std::cos(kPi * (y + 1) / map.height);
            for (int j = 0; j < kInner; ++j) {
                const double cosine = lower + (upper - lower) * (j + 0.5) / kInner;
                const double sine = std::sqrt(1.0 - cosine * cosine);
                for (int x = 0; x < map.width * kInner; ++x) {
                    const double phi = 2.0 * kPi * ((x + 0.5) / (map.width * kInner) - 0.5);
                    directions.emplace_back(sine * std::sin(phi), cosine, -sine * std::cos(phi), 0.0);
                    areas.push_back(2.0 * kPi * (upper - lower) / (map.width * kInner * kInner));
                }
            }
        }
        OnDevice device(environment, GetParam());
        const std::vector<Answer> answers = device.lookUp(directions);
        float largest = 0.0F;
        for (const float value : map.texels) largest = std::max(largest, value);
        double integral = 0.0;
        for (std::size_t i = 0; i < answers.size(); ++i) {
            integral += d(answers[i].radiance_pdf.w) * areas[i];
            const Place place = placeOf(environment, dvec3(directions[i]));
            const double expected = radiance(map, place.u * map.width, place.v * map.height);
            // The steepest interpolant climbs by the largest value within a texel.
            const double moved = place.error_u * map.width + kErrorV * map.height;
            EXPECT_NEAR(d(luminance(vec3(answers[i].radiance_pdf))), expected,
                        (moved + 8.0 * kUnit) * d(largest))
                << environment.name << " " << i;
        }
        // The density is constant over a texel, so the sum is exact but for rounding: of share and solid
        // angle, whose two sines and three products are each good to 3 u.
        EXPECT_NEAR(integral, 1.0, 16.0 * kUnit) << environment.name;
    }
}

/// Mean and its variance of L / pdf times max(normal . w, 0).
struct Irradiance {
    double mean = 0.0;
    double variance = 0.0;
};
Irradiance irradiance(const std::vector<Answer>& answers, const dvec3& normal) {
    double sum = 0.0;
    double squares = 0.0;
    for (const Answer& answer : answers) {
        const double value = d(luminance(vec3(answer.radiance_pdf))) / d(answer.direction_pdf.w) *
                             std::max(glm::dot(dvec3(answer.direction_pdf), normal), 0.0);
        sum += value;
        squares += value * value;
    }
    const auto n = static_cast<double>(answers.size());
    return {sum / n, (squares / n - sum * sum / (n * n)) / n};
}

// E = integral of L cos over the interpolated texel, a sun of 1e6 in the dark.
TEST_P(EveryMethod, aSunOfOneTexelGivesItsIrradiance) {
    constexpr float kSun = 1e6F;
    const Environment sun = singleTexel(kSun);
    const dvec3 normal = glm::normalize(dvec3(-0.3, 0.8, 0.4));
    // The interpolant reaches a texel beyond: midpoints of a fine grid.
    constexpr int kInner = 64;
    double exact = 0.0;
    for (int j = 0; j < 3 * kInner; ++j) {
        for (int i = 0; i < 3 * kInner; ++i) {
            const double x = 19.0 + (i + 0.5) / kInner;
            const double y = 9.0 + (j + 0.5) / kInner;
            const double theta = kPi * y / 32.0;
            const double phi = 2.0 * kPi * (x / 64.0 - 0.5);
            const dvec3 w(std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi));
            exact += radiance(sun.radiance, x, y) * std::max(glm::dot(w, normal), 0.0) * std::sin(theta) *
                     (kPi / 32.0 / kInner) * (2.0 * kPi / 64.0 / kInner);
        }
    }
    ASSERT_GT(exact, 0.0);
    for (const std::uint32_t sampler : {kSamplerRandom, kSamplerSobol}) {
        const Irradiance found = irradiance(OnDevice(sun, GetParam(), sampler).sample(), normal);
        // The midpoint rule is off by 1e-5 of it at most: (1 / 64)^2 / 24.
        EXPECT_NEAR(found.mean, exact, 4.0 * std::sqrt(found.variance) + 2e-5 * exact);
    }
}

INSTANTIATE_TEST_SUITE_P(Environment, EveryMethod, testing::ValuesIn(kMethods),
                         [](const auto& instance) { return nameOf(instance.param); });

TEST(Methods, haveTheSameMean) {
    const dvec3 normal(0.6, 0.0, 0.8);
    for (const Environment& environment : environments()) {
        std::vector<Irradiance> found;
        for (const EnvironmentSampling how : kMethods)
            found.push_back(irradiance(OnDevice(environment, how).sample(), normal));
        for (std::size_t i = 1; i < found.size(); ++i)
            EXPECT_NEAR(found[i].mean, found[0].mean,
                        4.5 * std::sqrt(found[i].variance + found[0].variance) + 1e-5 * found[0].mean)
                << environment.name << " " << nameOf(kMethods[i]);
    }
}

// Tries follow the geometric law with the chance 1 / (4 pi peak), cut off after the last.
TEST(Rejection, triesAreAsTheLawSays) {
    for (const Environment& environment : environments()) {
        const double peak = d(tableOf(environment, EnvironmentSampling::rejection).peak);
        const double chance = 0.25 / (kPi * peak);
        const double refused = std::pow(1.0 - chance, double{kEnvironmentMostTries});
        const double mean = (1.0 - refused) / chance;
        double sum = 0.0;
        double squares = 0.0;
        for (const Answer& answer : OnDevice(environment, EnvironmentSampling::rejection).sample()) {
            ASSERT_LE(d(answer.tries.x), double{kEnvironmentMostTries});
            sum += d(answer.tries.x);
            squares += d(answer.tries.x) * d(answer.tries.x);
        }
        sum /= kCount;
        squares /= kCount;
        const double deviation = std::sqrt(std::max(squares - sum * sum, 0.0) / kCount);
        EXPECT_NEAR(sum, mean, 4.5 * deviation + 1e-5 * mean) << environment.name;
    }
}

// About +Y, counter-clockwise from above: a quarter carries what was at -Z to -X.
TEST(EnvironmentTurn, AQuarterCarriesTheMiddleOfTheMapToMinusX) {
    Environment columns = filled("columns", 4, 1, 0.0F);
    for (int x = 0; x < 4; ++x) set(columns, x, 0, static_cast<float>(1 << x));
    const auto seenAlong = [&](float x, float z) {
        OnDevice device(columns, EnvironmentSampling::alias);
        return d(device.lookUp({vec4(x, 0.0F, z, 0.0F)}).front().radiance_pdf.x);
    };
    // Each of these directions lies between two columns.
    EXPECT_NEAR(seenAlong(0.0F, -1.0F), 3.0, 1e-5);
    columns.turn = 0.25F;
    EXPECT_NEAR(seenAlong(-1.0F, 0.0F), 3.0, 1e-5);
    EXPECT_NEAR(seenAlong(0.0F, -1.0F), 6.0, 1e-5);
    columns.turn = 0.5F;
    EXPECT_NEAR(seenAlong(0.0F, 1.0F), 3.0, 1e-5);
}

// Sobol's numbers leave the stretch of the map from which a row and a column are drawn whole.
TEST(Inversion, keepsEvenNumbersEven) {
    const Environment constant = filled("constant", 64, 32, 1.0F);
    const auto unevenness = [&](EnvironmentSampling how) {
        // Blue noise with one sample a pixel: all pixels together are evenly spread.
        std::vector<std::uint64_t> counts(64 * 32);
        for (const Answer& answer : OnDevice(constant, how, kSamplerBlue).sample()) {
            const dvec3 w(answer.direction_pdf);
            const auto column = static_cast<std::size_t>(std::min(placeOf(constant, w).u * 64.0, 63.0));
            const auto row = static_cast<std::size_t>(std::clamp(16.0 - 16.0 * w.y, 0.0, 31.0));
            ++counts[row * 64 + column];
        }
        return chiSquareTest(counts, std::vector<double>(counts.size(), double{kCount} / (64 * 32)))
            .statistic;
    };
    // Independent numbers give 2047. A box of 2^-11 that even numbers fill is off by a few of 256 at its rim.
    EXPECT_LT(unevenness(EnvironmentSampling::inversion), 0.1 * 2047.0);
}

}  // namespace
}  // namespace licht
