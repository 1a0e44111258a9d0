// What is known of every closed mesh without a reference tracer: a line crosses it an even number of times,
// isotropic uniform lines through a sphere of radius R around it cross it S / (2 pi R^2) times on average
// (Cauchy 1841, Crofton 1868), and cosine-distributed rays from its walls run 4 V / S on average.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>

#include "hard.h"

namespace licht {
namespace {

using test::Caster;
using test::Hits;
using test::Mesh;
using test::Random;

struct Crossings {
    double mean = 0.0;
    double standard_error = 0.0;
    std::size_t odd = 0;
    double hit_share = 0.0;
};

constexpr std::size_t kBatch = 250'000;

/// How often each of `count` lines through the sphere of that radius around the origin crosses the mesh.
std::vector<int> crossed(Caster& caster, float radius, std::size_t count, Random& random) {
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < count; ++i) {
        const vec3 d = random.direction();
        // A point of the disc across the direction.
        const vec3 side = glm::normalize(glm::cross(d, std::abs(d.x) < 0.5F ? vec3(1, 0, 0) : vec3(0, 1, 0)));
        const float r = radius * std::sqrt(random.uniform(0.0F, 1.0F));
        const float phi = random.uniform(0.0F, 2.0F * kPi);
        rays.push_back(
            {r * std::cos(phi) * side + r * std::sin(phi) * glm::cross(d, side) - 2.0F * radius * d, d});
    }
    std::vector<int> crossings(count, 0);
    std::vector<std::size_t> of(count);
    for (std::size_t i = 0; i < count; ++i) {
        of[i] = i;
    }
    while (!rays.empty()) {
        const Hits hits = caster.nearest(rays);
        std::vector<Ray> going;
        std::vector<std::size_t> whose;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (hits[i]) {
                ++crossings[of[i]];
                going.push_back(rays[i]);
                going.back().t_min = std::nextafter(hits[i]->t, kInfinity);
                whose.push_back(of[i]);
            }
        }
        rays = std::move(going);
        of = std::move(whose);
    }
    return crossings;
}

Crossings crossingsOf(Caster& caster, float radius, std::size_t count) {
    Random random(1);
    Crossings result;
    double squares = 0.0;
    for (std::size_t done = 0; done < count; done += kBatch) {
        for (const int c : crossed(caster, radius, kBatch, random)) {
            result.mean += c;
            squares += static_cast<double>(c) * c;
            result.odd += c % 2 == 0 ? 0U : 1U;
            result.hit_share += c > 0 ? 1.0 : 0.0;
        }
    }
    const auto n = static_cast<double>(count);
    result.mean /= n;
    result.hit_share /= n;
    result.standard_error = std::sqrt((squares / n - result.mean * result.mean) / n);
    return result;
}

/// A cosine-distributed ray into the convex body around the origin whose wall this is.
Ray fromWall(const BvhTriangle& t, Random& random) {
    float u = random.uniform(0.0F, 1.0F);
    float v = random.uniform(0.0F, 1.0F);
    if (u + v > 1.0F) {
        u = 1.0F - u;
        v = 1.0F - v;
    }
    const vec3 point = t.v0 + u * (t.v1 - t.v0) + v * (t.v2 - t.v0);
    vec3 inward = glm::normalize(glm::cross(t.v1 - t.v0, t.v2 - t.v0));
    inward = glm::dot(inward, point) > 0.0F ? -inward : inward;
    // The end of the normal plus a point of the unit sphere is cosine-distributed seen from the wall.
    return {point + 1e-5F * inward, glm::normalize(inward + random.direction())};
}

class ClosedMesh : public test::OnBoth {};

TEST_P(ClosedMesh, LinesCrossACubeAsCauchyAndCroftonSay) {
    Caster caster(test::cube(0.5F), GetParam());
    const std::size_t count = test::often(250'000, 20'000'000);
    const Crossings c = crossingsOf(caster, 1.0F, count);
    std::cout << "mean " << c.mean << ", odd " << c.odd << " of " << count << '\n';
    EXPECT_NEAR(c.mean, 0.954930, 4.5 * c.standard_error + 1e-5);
    // Convex: hit with probability S / (4 pi R^2).
    const double p = 0.477465;
    EXPECT_NEAR(c.hit_share, p, 4.5 * std::sqrt(p * (1.0 - p) / static_cast<double>(count)) + 1e-5);
    EXPECT_EQ(c.odd, 0U);
}

TEST_P(ClosedMesh, LinesCrossANoisySphereAnEvenNumberOfTimes) {
    const Mesh mesh = test::noisy(test::sphere(vec3(0.0F), 0.8F, 32, 64), vec3(0.0F), 0.1F);
    const double area = test::areaOf(mesh.triangles);
    Caster caster(mesh.triangles, GetParam());
    const std::size_t count = test::often(250'000, 20'000'000);
    const Crossings c = crossingsOf(caster, 1.0F, count);
    std::cout << "mean " << c.mean << " of " << area / (2.0 * std::numbers::pi) << ", odd " << c.odd << " of "
              << count << '\n';
    EXPECT_NEAR(c.mean, area / (2.0 * std::numbers::pi), 4.5 * c.standard_error + 1e-5);
    // Edges belong to both their triangles: a line that goes through one exactly counts twice.
    EXPECT_LE(static_cast<double>(c.odd), 1e-5 * static_cast<double>(count));
}

TEST_P(ClosedMesh, CosineRaysRunFourVolumesPerSurface) {
    for (const bool is_cube : {true, false}) {
        const std::vector<BvhTriangle> triangles =
            is_cube ? test::cube(0.5F) : test::sphere(vec3(0.0F), 1.0F, 32, 64).triangles;
        const double exact = 4.0 * test::volumeOf(triangles) / test::areaOf(triangles);
        std::vector<double> sums;
        double sum = 0.0;
        for (const BvhTriangle& t : triangles) {
            sums.push_back(sum += test::areaOf({t}));
        }
        Random random(2);
        Caster caster(triangles, GetParam());
        const std::size_t count = test::often(250'000, 20'000'000);
        double mean = 0.0;
        double squares = 0.0;
        for (std::size_t done = 0; done < count; done += kBatch) {
            std::vector<Ray> rays;
            for (std::size_t i = 0; i < kBatch; ++i) {
                const auto at = std::lower_bound(sums.begin(), sums.end(),
                                                 static_cast<double>(random.uniform(0, 1)) * sum);
                rays.push_back(fromWall(triangles[static_cast<std::size_t>(at - sums.begin())], random));
            }
            const Hits hits = caster.nearest(rays);
            EXPECT_EQ(test::missesOf(hits), 0U);
            for (const auto& hit : hits) {
                const auto t = static_cast<double>(hit ? hit->t : 0.0F);
                mean += t;
                squares += t * t;
            }
        }
        const auto n = static_cast<double>(count);
        mean /= n;
        // Starting 1e-5 inside shortens a ray by 1e-5 / cos, 2e-5 on average.
        std::cout << "mean free path " << mean << " of " << exact << '\n';
        EXPECT_NEAR(mean, exact, 4.5 * std::sqrt((squares / n - mean * mean) / n) + 2e-5);
    }
}

INSTANTIATE_TEST_SUITE_P(Hard, ClosedMesh, testing::Values(test::Where::host, test::Where::device),
                         test::nameOfWhere);

}  // namespace
}  // namespace licht
