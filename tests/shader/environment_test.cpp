// Sampling of environment maps on the device, against their tables and the radiance that the maps stand for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "histogram.h"
#include "kernel.h"
#include "licht/colour/transfer.h"
#include "licht/gpu/upload_image.h"
#include "licht/render/light_table.h"
#include "licht/shared/records.h"
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
    return all;
}
constexpr int kTests = 7;  // chi-square tests in this file: one an environment

struct Answer {
    vec4 direction_pdf;
    vec4 radiance_pdf;  // looked up
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
Place placeOf(const dvec3& w) {
    const double horizontal = std::hypot(w.x, w.z);
    return {0.5 + std::atan2(w.x, -w.z) / (2.0 * kPi), std::atan2(horizontal, w.y) / kPi,
            kErrorU + 4.0 * kUnit / std::max(horizontal, 1e-30)};
}

class OnDevice {
public:
    explicit OnDevice(const Environment& environment)
        : table_(buildEnvironmentTable(environment)),
          sampler_(gpu::testDevice(), VK_FILTER_NEAREST, VK_SAMPLER_ADDRESS_MODE_REPEAT,
                   VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE) {
        const Image& map = environment.radiance;
        FrameRecord frame{};
        frame.environment_size = uvec2(map.width, map.height);
        frame.seed = 7;
        frame_ = gpu::uploadBuffer(gpu::testDevice(), "FrameBlock", std::span<const FrameRecord>(&frame, 1),
                                   VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
        alias_ = gpu::uploadBuffer(gpu::testDevice(), "EnvironmentAlias",
                                   std::span<const AliasRecord>(table_), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
        std::vector<vec4> texels;
        for (std::size_t i = 0; i < map.texels.size(); i += 3)
            texels.emplace_back(map.texels[i], map.texels[i + 1], map.texels[i + 2], 0.0F);
        map_ = gpu::uploadImage(
            gpu::testDevice(), "environment_map", {frame.environment_size.x, frame.environment_size.y},
            VK_FORMAT_R32G32B32A32_SFLOAT, std::as_bytes(std::span(texels)), VK_IMAGE_USAGE_SAMPLED_BIT);
    }

    [[nodiscard]] const std::vector<AliasRecord>& table() const { return table_; }
    std::vector<Answer> sample() { return run({kCount, 0}, {vec4(0.0F)}); }
    std::vector<Answer> lookUp(const std::vector<vec4>& directions) {
        return run({static_cast<std::uint32_t>(directions.size()), 1}, directions);
    }

private:
    std::vector<Answer> run(const Push& push, const std::vector<vec4>& directions) {
        return kernel_.run<Answer>(push.count, push.count, push, directions,
                                   {{"FrameBlock", &frame_},
                                    {"EnvironmentAlias", &alias_},
                                    {"environment_map", gpu::SampledImage{&map_, &sampler_}}});
    }

    test::Kernel kernel_{"environment", environment_comp};
    std::vector<AliasRecord> table_;
    gpu::Buffer frame_;
    gpu::Buffer alias_;
    gpu::Image map_;
    gpu::Sampler sampler_;
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

TEST(Environment, theTableFollowsTheRadiance) {
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
        const std::vector<AliasRecord> table = buildEnvironmentTable(environment);
        ASSERT_EQ(table.size(), power.size());
        // Luminance in fp32 rounds three products and two sums.
        for (std::size_t i = 0; i < power.size(); ++i)
            EXPECT_NEAR(d(table[i].pmf), power[i] / total, 8.0 * kUnit * power[i] / total)
                << environment.name << " " << i;
    }
}

TEST(Environment, directionsFollowTheTable) {
    for (const Environment& environment : environments()) {
        const auto width = static_cast<std::size_t>(environment.radiance.width);
        const auto height = static_cast<std::size_t>(environment.radiance.height);
        OnDevice device(environment);
        // Four cells a texel: within it directions are uniform by solid angle.
        std::vector<std::uint64_t> counts(4 * width * height);
        std::vector<double> expected(counts.size());
        for (std::size_t i = 0; i < expected.size(); ++i)
            expected[i] = 0.25 * kCount * d(device.table()[i / 4].pmf);
        for (const Answer& answer : device.sample()) {
            const dvec3 w(answer.direction_pdf);
            ASSERT_NEAR(glm::length(w), 1.0, 1e-6);
            const Place place = placeOf(w);
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

TEST(Environment, bothDensitiesAgree) {
    for (const Environment& environment : environments()) {
        const auto width = static_cast<double>(environment.radiance.width);
        const auto height = static_cast<double>(environment.radiance.height);
        OnDevice device(environment);
        std::size_t at_edges = 0;
        double inverse = 0.0;
        double inverse2 = 0.0;
        for (const Answer& answer : device.sample()) {
            const double pdf = d(answer.direction_pdf.w);
            ASSERT_GT(pdf, 0.0);
            inverse += 1.0 / pdf;
            inverse2 += 1.0 / (pdf * pdf);
            const Place place = placeOf(dvec3(answer.direction_pdf));
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
        for (std::size_t i = 0; i < device.table().size(); ++i) {
            const double row = std::floor(static_cast<double>(i) / width);
            if (device.table()[i].pmf > 0.0F)
                lit +=
                    2.0 * kPi / width * (std::cos(kPi * row / height) - std::cos(kPi * (row + 1.0) / height));
        }
        const double mean = inverse / kCount;
        const double variance = std::max(inverse2 / kCount - mean * mean, 0.0);
        EXPECT_NEAR(mean, lit, 4.5 * std::sqrt(variance / kCount) + 8.0 * kUnit * lit) << environment.name;
    }
}

TEST(Environment, densityIntegratesToOneAndRadianceIsBilinear) {
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
        OnDevice device(environment);
        const std::vector<Answer> answers = device.lookUp(directions);
        float largest = 0.0F;
        for (const float value : map.texels) largest = std::max(largest, value);
        double integral = 0.0;
        for (std::size_t i = 0; i < answers.size(); ++i) {
            integral += d(answers[i].radiance_pdf.w) * areas[i];
            const Place place = placeOf(dvec3(directions[i]));
            const double expected = radiance(map, place.u * map.width, place.v * map.height);
            // The steepest interpolant climbs by the largest value within a texel.
            const double moved = place.error_u * map.width + kErrorV * map.height;
            EXPECT_NEAR(d(luminance(vec3(answers[i].radiance_pdf))), expected,
                        (moved + 8.0 * kUnit) * d(largest))
                << environment.name << " " << i;
        }
        // The density is constant over a texel, so the sum is exact but for rounding of pmf and solid angle,
        // of which the difference of two edges' cosines near a pole loses most: u over the smallest, 1 -
        // cos(pi / height).
        const double smallest = 1.0 - std::cos(kPi / map.height);
        EXPECT_NEAR(integral, 1.0, 4.0 * kUnit / smallest + 8.0 * kUnit) << environment.name;
    }
}

}  // namespace
}  // namespace licht
