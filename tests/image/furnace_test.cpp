// A closed room in which everything emits and reflects alike: every pixel is known, and no ray may leave.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include "licht/bvh/bvh.h"
#include "licht/render/renderer.h"
#include "licht/shared/bvh_numerics.h"
#include "samples/scenes/builtin.h"
#include "samples/scenes/shapes.h"
#include "support/gpu_test.h"
#include "support/render_test.h"

namespace licht {
namespace {

RenderSettings square(std::uint32_t side, std::uint32_t bounces) {
    RenderSettings settings;
    settings.size = uvec2(side);
    settings.bounces = bounces;
    return settings;
}

// Where two walls meet. A triangle that reaches beside the origin is not met nearer than the rounding of its
// distance (kBvhDistanceSlack): for the wall x = 0 of the room, [0,2] x [-1,1] x [0,2] here, that is when the
// origin is within
//     w = slack P (P + 2 Z) spread / |determinant| * direction.x
// of it, and the ray leaves. The determinant is the triangle's area as the ray sees it, and has direction.x
// as a factor, so w is finite: this is a strip along the edge. Directions have density cosine / pi about the
// floor's normal z.
struct EdgeStrip {
    double mean = 0.0;    ///< metres, of w over places along the edge and all directions (those that lead
                          ///< away from the wall count as zero)
    double widest = 0.0;  ///< metres
};

double stripWidth(double y, const glm::dvec3& unit) {
    glm::length_t k = 0;
    for (glm::length_t i = 1; i < 3; ++i)
        if (std::abs(unit[i]) > std::abs(unit[k])) k = i;
    const glm::length_t i = (k + 1) % 3, j = (k + 2) % 3;
    const glm::dvec3 d = unit / std::exp2(std::floor(std::log2(std::abs(unit[k]))));  // as RaySetup scales it
    // One of both triangles holds all of the edge. Sheared: two coordinates beside the ray, one along it.
    glm::dvec3 beside[3];
    double nearest = 1e9, farthest = -1e9, pass = 0.0;
    const glm::dvec3 corners[3] = {{0.0, -1.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, -1.0, 2.0}};
    for (int corner = 0; corner < 3; ++corner) {
        const glm::dvec3 v = corners[corner] - glm::dvec3(0.0, y, 0.0);
        const double along = v[k] / d[k];
        beside[corner] = glm::dvec3(v[i] - d[i] * along, v[j] - d[j] * along, 0.0);
        nearest = std::min(nearest, along);
        farthest = std::max(farthest, along);
        pass = std::max({pass, std::abs(beside[corner].x), std::abs(beside[corner].y)});
    }
    const double determinant = std::abs(glm::cross(beside[1] - beside[0], beside[2] - beside[0]).z);
    const double reach = std::max(std::abs(nearest), std::abs(farthest));
    return static_cast<double>(kBvhDistanceSlack) * pass * (pass + 2.0 * reach) * (farthest - nearest) /
           determinant * d.x;
}

/// By the midpoint rule; with half as many places and directions the mean is the same to 0.2 %.
EdgeStrip edgeStrip() {
    constexpr int kSteps = 48;
    EdgeStrip strip;
    for (int place = 0; place < kSteps; ++place) {
        for (int ring = 0; ring < kSteps; ++ring) {
            for (int turn = 0; turn < kSteps; ++turn) {
                const double radius = std::sqrt((ring + 0.5) / kSteps);
                const double angle = ((turn + 0.5) / kSteps - 0.5) * std::numbers::pi;  // towards the wall
                const double width = stripWidth(
                    (place + 0.5) / kSteps * 2.0 - 1.0,
                    {radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1.0 - radius * radius)});
                strip.mean += 0.5 * width / (double{kSteps} * kSteps * kSteps);
                strip.widest = std::max(strip.widest, width);
            }
        }
    }
    return strip;
}

constexpr double kRoomSide = 2.0;
constexpr double kRoomStripLength = 12.0 * kRoomSide * 2.0;  // each edge has a strip on both of its walls

// The room without what is in it: rays of density cosine / pi from a strip of the floor that holds all of w,
// and from the rest, away from the walls at the ends.
TEST(Room, RaysLeaveByTheSlackOfDistancesAlone) {
    const Mesh box = boxMesh("room", 0, vec3(-1.0F), vec3(1.0F));
    std::vector<BvhTriangle> walls;
    for (const uvec3& t : box.triangles)
        walls.push_back({box.positions[t.x], box.positions[t.y], box.positions[t.z]});
    const EdgeStrip strip = edgeStrip();
    constexpr double kSampled = 1e-4;
    ASSERT_LT(strip.widest, kSampled);

    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
    constexpr int kRays = 400'000;
    const auto left = [&](float nearest, float farthest) {
        int count = 0;
        for (int i = 0; i < kRays; ++i) {
            const float x = -1.0F + nearest + (farthest - nearest) * uniform(random);
            const float y = (1.0F - static_cast<float>(kSampled)) * (2.0F * uniform(random) - 1.0F);
            const vec3 origin(x, y, -1.0F + 6e-6F);  // the path tracer's own offset is 96 units here
            const float square = uniform(random);
            const float angle = 2.0F * std::numbers::pi_v<float> * uniform(random);
            const vec3 direction(std::sqrt(square) * std::cos(angle), std::sqrt(square) * std::sin(angle),
                                 std::sqrt(1.0F - square));
            if (!intersectBruteForce(std::span<const BvhTriangle>(walls), {origin, direction})) ++count;
        }
        return count;
    };
    const double expected = kRays * strip.mean / kSampled;
    const int in_strip = left(0.0F, static_cast<float>(kSampled));
    std::cout << "left " << in_strip << ", expected " << expected << '\n';
    // 0.5 %: the quadrature, and the two units by which origins near 1 are rounded, of about 100.
    EXPECT_NEAR(in_strip, expected, 4.5 * std::sqrt(expected) + 5e-3 * expected);
    EXPECT_EQ(left(static_cast<float>(kSampled), 2.0F - static_cast<float>(kSampled)), 0);
}

/// Sees a whole wall of the room from outside, through the one opposite to it, whose back it does not draw.
Camera wallCamera(int wall) {
    const glm::length_t k = wall / 2;
    vec3 back(0.0F), up(0.0F);
    back[k] = wall % 2 == 0 ? 1.0F : -1.0F;
    up[(k + 1) % 3] = 1.0F;
    Camera camera = downCamera(vec3(0.0F), 0.999F, 3.0F);  // no sample is rounded to the outside
    camera.world_from_view =
        mat4(vec4(glm::cross(up, back), 0), vec4(up, 0), vec4(back, 0), vec4(3.0F * back, 1));
    return camera;
}

// Any closed shape, emission Le and albedo r everywhere: L_n = Le (1 - r^(n+1)) / (1 - r) in every pixel,
// without noise, because every sample of every bounce is worth exactly r. Rounding: two per bounce of a sum
// that stays below twice its first term.
//
// But for rays that leave by the strips above: their paths end early. How many may: the six pictures together
// start rays on a surface of normal n with a density of at most (|n.x| + |n.y| + |n.z|) / (6 * picture) <=
// sqrt(3) / (6 * picture) a square metre. A bounce averages densities (the kernel cosine cosine / (pi r^2) is
// symmetric and its integral one from every point of a closed room), so no later ray has more. So at most
// that density times the strips' area leaves.
TEST(Furnace, EveryBounceCountIsExactAndFreeOfNoise) {
    const Scene scene = *makeBuiltinScene("furnace");
    constexpr std::uint32_t kSide = 14;
    constexpr std::uint32_t kSamples = 4;
    double rays = 0.0;
    int darker = 0;
    for (const std::uint32_t bounces : {0U, 1U, 2U, 3U, 4U, 5U, 6U, 7U, 8U, 12U, 32U, 100U}) {
        RenderSettings settings = square(kSide, bounces);
        settings.roulette_start = bounces;  // a path ended by chance is noise
        const double exact = 0.5 * (1.0 - std::pow(0.5, bounces + 1.0)) / 0.5;
        Renderer renderer(gpu::testDevice(), scene, wallCamera(0), settings);
        for (int wall = 0; wall < 6; ++wall) {
            renderer.setCamera(wallCamera(wall));
            for (std::uint32_t i = 0; i < kSamples; ++i) renderer.renderSample();
            const Film film = renderer.readFilm();
            rays += double{kSide} * kSide * kSamples * bounces;
            for (std::size_t i = 0; i < std::size_t{kSide} * kSide; ++i) {
                // A deviation of one rounding (6e-8) in each sample is no noise.
                const bool noisy = film.variance.texels[3 * i] >= 1e-14F;
                if (noisy) ++darker;
                for (std::size_t c = 0; c < 3; ++c) {
                    const auto value = static_cast<double>(film.mean.texels[4 * i + c]);
                    ASSERT_LT(value, exact * (1.0 + 1e-4))
                        << bounces << " bounces, wall " << wall << ", pixel " << i;
                    if (noisy) continue;
                    ASSERT_GT(value, exact * (1.0 - 1e-4))
                        << bounces << " bounces, wall " << wall << ", pixel " << i;
                    ASSERT_LT(film.variance.texels[3 * i + c], 1e-14F)
                        << bounces << " bounces, wall " << wall << ", pixel " << i;
                }
            }
        }
        EXPECT_EQ(renderer.statistics().nonfinite_samples, 0U);
        EXPECT_EQ(renderer.statistics().truncated_traversals, 0U);
    }
    const double picture = 4.0 * 0.999 * 0.999;
    const double most = rays * std::sqrt(3.0) / (6.0 * picture) * kRoomStripLength * edgeStrip().mean;
    std::cout << darker << " pixels are darker, at most " << most << " are expected to be\n";
    EXPECT_LE(darker, most + 4.0 * std::sqrt(most));
}

// Albedo one: the series has no limit and grows by Le a bounce.
TEST(Furnace, AlbedoOneGrowsLinearly) {
    Scene scene = *makeBuiltinScene("furnace");
    scene.materials[0].base_color = vec4(1.0F);
    for (const std::uint32_t bounces : {1U, 10U, 100U}) {
        RenderSettings settings = square(16, bounces);
        settings.roulette_start = bounces;
        const Film film = renderFilm(scene, scene.cameras[0], settings, 2);
        expectMean(film, 0.5 * (bounces + 1.0));
        EXPECT_NEAR(pictureMean(film, 0).mean, 0.5 * (bounces + 1.0), 1e-4 * 0.5 * (bounces + 1.0));
    }
}

// Roulette is noise around the same mean, however early it begins.
TEST(Furnace, RouletteKeepsTheMean) {
    const Scene scene = *makeBuiltinScene("furnace");
    RenderSettings settings = square(64, 20);
    settings.roulette_start = 1;
    const Film film = renderFilm(scene, scene.cameras[0], settings, 64);
    expectMean(film, 1.0 - std::pow(0.5, 21));
    EXPECT_GT(pictureMean(film, 0).standard_error, 0.0);
}

}  // namespace
}  // namespace licht
