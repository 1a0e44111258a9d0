// Directions to places on a latitude-longitude map and back.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "kernel.h"
#include "licht/core/math.h"
#include "licht/spirv/latlong_comp.h"

namespace licht {
namespace {

constexpr double kPi = std::numbers::pi;

struct Push {
    std::uint32_t count;
};

std::vector<vec4> mapped(const std::vector<vec4>& directions) {
    test::Kernel kernel("latlong", latlong_comp);
    const auto count = static_cast<std::uint32_t>(directions.size());
    return kernel.run<vec4>(count, 2 * directions.size(), Push{count}, directions);
}

TEST(Latlong, theAxesAreWhereTheHeaderSays) {
    const std::vector<vec4> directions{{0, 1, 0, 0}, {0, -1, 0, 0}, {0, 0, -1, 0},
                                       {1, 0, 0, 0}, {-1, 0, 0, 0}, {0, 0, 1, 0}};
    const std::vector<vec4> answers = mapped(directions);
    EXPECT_NEAR(answers[0].y, 0.0F, 1e-6F);
    EXPECT_NEAR(answers[2].y, 1.0F, 1e-6F);
    const float wanted[] = {0.5F, 0.75F, 0.25F};
    for (std::size_t i = 2; i < 5; ++i) {
        EXPECT_NEAR(answers[2 * i].x, wanted[i - 2], 1e-6F) << i;
        EXPECT_NEAR(answers[2 * i].y, 0.5F, 1e-6F) << i;
    }
    const float seam = answers[10].x;
    EXPECT_NEAR(std::min(seam, 1.0F - seam), 0.0F, 1e-6F);
}

TEST(Latlong, roundTrip) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    std::vector<vec4> directions{{0, 1, 0, 0}, {0, -1, 0, 0}, {0, 0, 1, 0}, {-0.0F, 0, 1, 0}};
    const auto add = [&](double u, double theta) {
        const double phi = 2.0 * kPi * (u - 0.5);
        directions.emplace_back(std::sin(theta) * std::sin(phi), std::cos(theta),
                                -std::sin(theta) * std::cos(phi), 0.0);
    };
    for (int i = 0; i < 20'000; ++i) {
        const double tiny = std::pow(10.0, -8.0 * uniform(random));
        add(uniform(random), std::acos(1.0 - 2.0 * uniform(random)));
        add(uniform(random), tiny);                                              // near +Y
        add(uniform(random), kPi - tiny);                                        // near -Y
        add(i % 2 == 0 ? 0.1 * tiny : 1.0 - 0.1 * tiny, kPi * uniform(random));  // near the seam
    }
    const std::vector<vec4> answers = mapped(directions);
    double worst_u = 0.0;
    double worst_v = 0.0;
    double worst_trip = 0.0;
    for (std::size_t i = 0; i < directions.size(); ++i) {
        const glm::dvec3 direction(directions[i]);
        const glm::dvec2 uv(answers[2 * i]);
        ASSERT_TRUE(uv.x >= 0.0 && uv.x <= 1.0 && uv.y >= 0.0 && uv.y <= 1.0) << i;
        const double horizontal = std::hypot(direction.x, direction.z);
        if (horizontal > 0.0) {
            const double u = 0.5 + std::atan2(direction.x, -direction.z) / (2.0 * kPi);
            worst_u = std::max(worst_u, std::abs(std::remainder(uv.x - u, 1.0)));
        }
        worst_v = std::max(worst_v, std::abs(uv.y - std::atan2(horizontal, direction.y) / kPi));
        // Near a pole y alone says little of the distance from it: what y rounds off is no error of the map.
        const double lost = std::abs(std::sqrt(std::max(1.0 - direction.y * direction.y, 0.0)) - horizontal);
        worst_trip = std::max(worst_trip, glm::length(glm::dvec3(answers[2 * i + 1]) - direction) - lost);
    }
    RecordProperty("worst_u", std::to_string(1e6 * worst_u));
    RecordProperty("worst_v", std::to_string(1e6 * worst_v));
    RecordProperty("worst_trip", std::to_string(1e6 * worst_trip));
    // A thousandth of a texel of a map of 1024 times 512 texels, which are as wide as high; drivers' atan is
    // no better than this.
    const double angle = 2.0 * kPi * 1e-6;
    EXPECT_LT(worst_u, angle / (2.0 * kPi));
    EXPECT_LT(worst_v, angle / kPi);
    EXPECT_LT(worst_trip, angle);
}

}  // namespace
}  // namespace licht
