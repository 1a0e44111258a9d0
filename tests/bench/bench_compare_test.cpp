// When two hits count as the same.
#include "samples/licht/bench_compare.h"

#include <gtest/gtest.h>

#include <random>

#include "licht/shared/index.h"

namespace licht {
namespace {

using glm::dvec3;

RayRecord record(const Ray& ray) {
    return {ray.origin, ray.t_min, ray.direction, ray.t_max};
}

/// Where the ray meets the triangle's plane, in double precision.
double exactDistance(const Ray& ray, const BvhTriangle& triangle) {
    const dvec3 v0(triangle.v0);
    const dvec3 normal = glm::cross(dvec3(triangle.v1) - v0, dvec3(triangle.v2) - v0);
    return glm::dot(normal, v0 - dvec3(ray.origin)) / glm::dot(normal, dvec3(ray.direction));
}

TEST(DistanceBound, HoldsForTrianglesAndSliversNearAndFar) {
    std::mt19937 generator(1);
    std::uniform_real_distribution<float> uniform(-1.0F, 1.0F);
    const auto point = [&] { return vec3(uniform(generator), uniform(generator), uniform(generator)); };
    int hits = 0;
    for (int i = 0; i < 200'000; ++i) {
        const float size = std::ldexp(1.0F, -(i % 12));
        const vec3 at = 10.0F * point();
        BvhTriangle triangle{at + size * point(), at + size * point(), at + size * point()};
        if (i % 3 == 0)
            triangle.v2 = glm::mix(triangle.v0, triangle.v1, 0.4F) + std::ldexp(size, -(i % 10)) * point();
        const vec3 origin = 20.0F * point();
        const vec3 target = 0.4F * triangle.v0 + 0.3F * triangle.v1 + 0.3F * triangle.v2;
        const Ray ray{origin, (target - origin) * std::ldexp(1.0F, i % 7 - 3)};
        const auto hit = intersectTriangle(ray, triangle);
        if (!hit) continue;
        ++hits;
        EXPECT_LE(std::abs(exactDistance(ray, triangle) - static_cast<double>(hit->t)),
                  distanceBound(record(ray), triangle, hit->t));
    }
    EXPECT_GT(hits, 100'000);
}

TEST(DistanceBound, IsSmallForATriangleSeenFromInFront) {
    const RayRecord ray{{0.2F, 0.2F, 3.0F}, 0.0F, {0, 0, -1}, kInfinity};
    const BvhTriangle triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    // 96 u (3 + sqrt 2) * 2, worked out by hand.
    EXPECT_NEAR(distanceBound(ray, triangle, 3.0F), 96.0 * 0x1p-24 * (3.0 + std::sqrt(2.0)) * 2.0, 1e-12);
}

TEST(Differences, AreFoundWhereOneMissesOrHitsElsewhere) {
    const std::vector<BvhTriangle> triangles{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                             {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                             {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}};
    const std::vector<RayRecord> rays(6, RayRecord{{0.2F, 0.2F, 3.0F}, 0.0F, {0, 0, -1}, kInfinity});
    const std::vector<RayHitRecord> a{{2, 2.0F, 0, 0},     {0, 3.0F, 0, 0},     {2, 2.0F, 0, 0},
                                      {kNoIndex, 0, 0, 0}, {kNoIndex, 0, 0, 0}, {kRayTruncated, 0, 0, 0}};
    const std::vector<RayHitRecord> b{{2, 2.0F, 0, 0}, {1, 3.000001F, 0, 0}, {0, 3.0F, 0, 0},
                                      {2, 2.0F, 0, 0}, {kNoIndex, 5, 0, 0},  {2, 2.0F, 0, 0}};
    EXPECT_EQ(differences(triangles, rays, false, a, b), (std::vector<std::size_t>{2, 3, 5}));
    EXPECT_EQ(differences(triangles, rays, true, a, b), (std::vector<std::size_t>{3, 5}));
}

}  // namespace
}  // namespace licht
