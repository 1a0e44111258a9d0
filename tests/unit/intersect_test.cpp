// What rays find. Everything is compared bit for bit: the traversal promises what testing every triangle
// gives.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "bvh_meshes.h"
#include "licht/bvh/bvh.h"

namespace licht {
namespace {

using test::Mesh;
using test::Random;
using test::soup;
using test::sphere;

void expectSame(const std::optional<BvhHit>& hit, const std::optional<BvhHit>& expected) {
    ASSERT_EQ(hit.has_value(), expected.has_value());
    if (hit) {
        EXPECT_EQ(hit->triangle, expected->triangle);
        EXPECT_EQ(hit->t, expected->t);
        EXPECT_EQ(hit->b1, expected->b1);
        EXPECT_EQ(hit->b2, expected->b2);
    }
}

/// Returns how many rays hit.
int compareWithBruteForce(std::span<const BvhTriangle> triangles, std::span<const Ray> rays) {
    const Bvh bvh = buildBvh(triangles);
    int hits = 0;
    for (const Ray& ray : rays) {
        const auto hit = intersect(bvh, triangles, ray);
        expectSame(hit, intersectBruteForce(triangles, ray));
        hits += hit ? 1 : 0;
    }
    return hits;
}

std::vector<Ray> randomRays(int count, float half, std::uint32_t seed) {
    Random random(seed);
    std::vector<Ray> rays;
    for (int i = 0; i < count; ++i) {
        rays.push_back({random.inCube(half), random.direction()});
        if (i % 4 == 0) {
            rays.back().t_min = random.uniform(0.0F, 0.5F);
            rays.back().t_max = random.uniform(0.4F, 2.0F);
        }
    }
    return rays;
}

TEST(Intersect, OneTriangleByHand) {
    const BvhTriangle triangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    const Ray ray{{1, 2, 8}, {0, 0, -2}};
    const auto hit = intersectTriangle(ray, triangle);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->t, 4.0F);
    EXPECT_EQ(hit->b1, 0.25F);
    EXPECT_EQ(hit->b2, 0.5F);
    const auto from_below = intersectTriangle({{1, 2, -8}, {0, 0, 2}}, triangle);
    ASSERT_TRUE(from_below);
    EXPECT_EQ(from_below->t, 4.0F);
    EXPECT_FALSE(intersectTriangle({{3, 3, 8}, {0, 0, -2}}, triangle));
    EXPECT_FALSE(intersectTriangle({{1, 2, 8}, {0, 0, 2}}, triangle));
}

TEST(Intersect, TheRangeIsHalfOpen) {
    const std::vector<BvhTriangle> triangles{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
    const Bvh bvh = buildBvh(triangles);
    Ray ray{{1, 1, 4}, {0, 0, -1}};
    const auto hits = [&] {
        const bool hit = intersect(bvh, triangles, ray).has_value();
        EXPECT_EQ(hit, intersectTriangle(ray, triangles[0]).has_value());
        EXPECT_EQ(hit, intersectBruteForce(triangles, ray).has_value());
        return hit;
    };
    ray.t_min = 4.0F;
    EXPECT_TRUE(hits());
    ray.t_min = std::nextafter(4.0F, 5.0F);
    EXPECT_FALSE(hits());
    ray.t_min = 0.0F;
    ray.t_max = 4.0F;
    EXPECT_FALSE(hits());
    ray.t_max = std::nextafter(4.0F, 5.0F);
    EXPECT_TRUE(hits());
}

TEST(Intersect, RandomSoups) {
    EXPECT_GT(compareWithBruteForce(soup(1'000, 0.2F, 1), randomRays(4'000, 1.5F, 2)), 1'000);
    EXPECT_GT(compareWithBruteForce(soup(2'000, 0.02F, 3), randomRays(2'000, 1.0F, 4)), 10);
}

TEST(Intersect, ThinSlivers) {
    Random random(5);
    std::vector<BvhTriangle> triangles;
    for (int i = 0; i < 1'000; ++i) {
        const vec3 a = random.inCube(1.0F);
        const vec3 b = random.inCube(1.0F);
        triangles.push_back({a, b, glm::mix(a, b, 0.3F) + random.inCube(std::ldexp(1.0F, -(i % 24)))});
    }
    std::vector<Ray> rays = randomRays(2'000, 1.5F, 6);
    for (int i = 0; i < 2'000; ++i) {  // along slivers, so that they are seen edge on
        const BvhTriangle& triangle = triangles[random.index(triangles.size())];
        const vec3 origin = random.inCube(1.5F);
        rays.push_back({origin, glm::mix(triangle.v0, triangle.v1, random.uniform(0.0F, 1.0F)) - origin});
    }
    EXPECT_GT(compareWithBruteForce(triangles, rays), 1'000);
}

TEST(Intersect, CoplanarDuplicatesGoToTheLowerIndex) {
    Random random(7);
    std::vector<BvhTriangle> triangles;
    for (int copy = 0; copy < 8; ++copy) {
        Random same(8);
        for (int i = 0; i < 60; ++i) {  // a floor; the rays graze it
            const vec3 at = same.inCube(4.0F);
            vec3 v[3];
            for (vec3& vertex : v) {
                vertex = at + same.inCube(3.0F);
                vertex.y = 0.7F;
            }
            triangles.push_back({v[0], v[1], v[2]});
        }
    }
    std::vector<Ray> rays;
    for (int i = 0; i < 3'000; ++i) {
        const vec3 origin = random.inCube(4.0F);
        rays.push_back({origin, vec3(random.inCube(4.0F).x, 0.7F, random.inCube(4.0F).z) - origin});
    }
    EXPECT_GT(compareWithBruteForce(triangles, rays), 2'000);
    const Bvh bvh = buildBvh(triangles);
    for (const Ray& ray : rays) {
        const auto hit = intersect(bvh, triangles, ray);
        EXPECT_TRUE(!hit || hit->triangle < 60U);
    }
}

TEST(Intersect, AxisParallelRaysInThePlanesOfFlatBoxes) {
    // A grid of walls whose boxes are flat; origins lie exactly on planes, edges and corners.
    std::vector<BvhTriangle> triangles;
    for (int axis = 0; axis < 3; ++axis) {
        for (int i = 0; i < 4; ++i) {
            for (int j = 0; j < 4; ++j) {
                const auto corner = [&](int a, int b) {
                    vec3 p(0.0F);
                    p[axis] = static_cast<float>(i);
                    p[(axis + 1) % 3] = static_cast<float>(j + a);
                    p[(axis + 2) % 3] = static_cast<float>(b);
                    return p;
                };
                triangles.push_back({corner(0, 0), corner(1, 0), corner(1, 1)});
                triangles.push_back({corner(0, 0), corner(1, 1), corner(0, 1)});
            }
        }
    }
    std::vector<Ray> rays;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float sign : {1.0F, -1.0F}) {
            for (int i = -1; i <= 9; ++i) {
                for (int j = -1; j <= 9; ++j) {
                    Ray ray;
                    ray.origin[axis] = -6.0F * sign;
                    ray.origin[(axis + 1) % 3] = 0.5F * static_cast<float>(i);
                    ray.origin[(axis + 2) % 3] = 0.5F * static_cast<float>(j);
                    ray.direction = vec3(sign > 0.0F ? 0.0F : -0.0F);
                    ray.direction[axis] = sign;
                    rays.push_back(ray);
                }
            }
        }
    }
    EXPECT_GT(compareWithBruteForce(triangles, rays), 100);
}

TEST(Intersect, ScalingByPowersOfTwoScalesTheDistance) {
    const auto triangles = soup(500, 0.2F, 9);
    const auto rays = randomRays(500, 1.5F, 10);
    const Bvh bvh = buildBvh(triangles);
    for (int exponent = -14; exponent <= 20; ++exponent) {
        const float scale = std::ldexp(1.0F, exponent);
        std::vector<BvhTriangle> scaled;
        for (const BvhTriangle& triangle : triangles) {
            scaled.push_back({triangle.v0 * scale, triangle.v1 * scale, triangle.v2 * scale});
        }
        const Bvh scaled_bvh = buildBvh(scaled);
        for (const Ray& ray : rays) {
            auto expected = intersect(bvh, triangles, ray);
            if (expected) {
                expected->t *= scale;
            }
            expectSame(intersect(scaled_bvh, scaled,
                                 {ray.origin * scale, ray.direction, ray.t_min * scale, ray.t_max * scale}),
                       expected);
        }
    }
}

/// Rays that leave a closed mesh and find no way out of it. Towards random points, vertices and midpoints of
/// edges in turn.
int escapes(const Mesh& mesh, const vec3& centre, float inside, int count, std::uint32_t seed) {
    const Bvh bvh = buildBvh(mesh.triangles);
    EXPECT_EQ(bvh.dropped, 0U);
    Random random(seed);
    int escaped = 0;
    for (int i = 0; i < count; ++i) {
        const vec3 origin = i % 5 == 0 ? centre : centre + random.inCube(inside);
        const BvhTriangle& triangle = mesh.triangles[random.index(mesh.triangles.size())];
        vec3 direction = random.direction();
        if (i % 3 == 1) {
            direction = mesh.vertices[random.index(mesh.vertices.size())] - origin;
        } else if (i % 3 == 2) {
            direction = 0.5F * (triangle.v0 - origin) + 0.5F * (triangle.v1 - origin);
        }
        escaped += intersect(bvh, mesh.triangles, {origin, direction}) ? 0 : 1;
    }
    return escaped;
}

TEST(Intersect, NoRayEscapesAClosedSphere) {
    EXPECT_EQ(escapes(sphere(vec3(0.0F), 2.0F, 48, 96), vec3(0.0F), 1.0F, 200'000, 11), 0);
}

TEST(Intersect, NoRayEscapesAClosedSphereFarFromTheOrigin) {
    const vec3 centre(148376.0F, 1234.0F, -223423.0F);
    EXPECT_EQ(escapes(sphere(centre, 2.0F, 12, 24), centre, 1.0F, 200'000, 12), 0);
}

TEST(Intersect, NoRayEscapesASphereOfSliversInALargeScene) {
    EXPECT_EQ(escapes(sphere(vec3(7.3F, -2.9F, 0.4F), 1'000.0F, 3, 4'000), vec3(7.3F, -2.9F, 0.4F), 300.0F,
                      100'000, 13),
              0);
}

TEST(Intersect, TheHubOfAFanIsHit) {
    for (int blades = 4; blades <= 1024; blades *= 2) {
        const vec3 hub(0.1F, 0.2F, 0.3F);
        std::vector<BvhTriangle> fan;
        const auto rim = [&](int i) {
            const float angle = 2.0F * kPi * static_cast<float>(i % blades) / static_cast<float>(blades);
            return hub + vec3(std::cos(angle), std::sin(angle), 0.1F * std::sin(3.0F * angle));
        };
        for (int i = 0; i < blades; ++i) {
            fan.push_back({hub, rim(i), rim(i + 1)});
        }
        const Bvh bvh = buildBvh(fan);
        Random random(14);
        for (int i = 0; i < 200; ++i) {
            const vec3 origin = hub + vec3(random.uniform(-0.5F, 0.5F), random.uniform(-0.5F, 0.5F), 3.0F);
            const Ray ray{origin, hub - origin};
            const auto hit = intersect(bvh, fan, ray);
            ASSERT_TRUE(hit) << blades;
            // The hub is at t = 1 and 3 away or a little more. A vertex is sheared by at most (2 * 0.5 + 8 *
            // 3) u sideways, u = 2^-24; blades rise by at most 0.32 of that, over a length of 3; the distance
            // itself is rounded six times: less than 16 u.
            EXPECT_NEAR(hit->t, 1.0F, 16.0F * 0x1p-24F);
            expectSame(hit, intersectBruteForce(fan, ray));
        }
    }
}

TEST(Intersect, TheLengthOfTheDirectionScalesTheDistance) {
    const auto triangles = soup(300, 0.4F, 15);
    const Bvh bvh = buildBvh(triangles);
    for (Ray ray : randomRays(300, 1.2F, 16)) {
        ray.t_min = 0.0F;
        ray.t_max = kInfinity;
        const auto expected = intersect(bvh, triangles, ray);
        for (const float length : {1e-15F, 1e-9F, 1e-3F, 1e3F, 1e9F, 1e15F}) {
            const Ray stretched{ray.origin, ray.direction * length};
            const auto hit = intersect(bvh, triangles, stretched);
            expectSame(hit, intersectBruteForce(triangles, stretched));
            ASSERT_EQ(hit.has_value(), expected.has_value());
        }
        for (const int exponent : {-50, -20, 20, 50}) {
            const auto hit =
                intersect(bvh, triangles, {ray.origin, ray.direction * std::ldexp(1.0F, exponent)});
            ASSERT_EQ(hit.has_value(), expected.has_value());
            if (hit) {
                EXPECT_EQ(hit->triangle, expected->triangle);
                EXPECT_EQ(hit->t, std::ldexp(expected->t, -exponent));
            }
        }
    }
}

TEST(Intersect, RaysThatAreNotFiniteMiss) {
    const std::vector<BvhTriangle> triangles{{{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}}};
    const Bvh bvh = buildBvh(triangles);
    const Ray good{{0, 0, 1}, {0, 0, -1}};
    ASSERT_TRUE(intersect(bvh, triangles, good));
    const auto expectMiss = [&](const Ray& ray) {
        EXPECT_FALSE(intersect(bvh, triangles, ray));
        EXPECT_FALSE(intersectBruteForce(triangles, ray));
        EXPECT_FALSE(intersectTriangle(ray, triangles[0]));
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const float bad : {nan, kInfinity, -kInfinity}) {
        for (int axis = 0; axis < 3; ++axis) {
            Ray ray = good;
            ray.origin[axis] = bad;
            expectMiss(ray);
            ray = good;
            ray.direction[axis] = bad;
            expectMiss(ray);
        }
    }
    expectMiss({{0, 0, 1}, {0, 0, 0}});
    expectMiss({{0, 0, 1}, {0, 0, -1}, nan, 2.0F});
    expectMiss({{0, 0, 1}, {0, 0, -1}, 0.0F, nan});
    expectMiss({{0, 0, 1}, {0, 0, -1}, 2.0F, 1.0F});
}

TEST(Intersect, TrianglesInEveryOrderOfMagnitude) {
    Random random(17);
    std::vector<BvhTriangle> triangles;
    std::vector<Ray> rays;
    for (int i = 0; i < 600; ++i) {
        const float scale = std::ldexp(1.0F, i / 10 - 40);
        const vec3 at = random.inCube(scale);
        triangles.push_back(
            {at + random.inCube(scale), at + random.inCube(scale), at + random.inCube(scale)});
        const vec3 origin = random.inCube(4.0F * scale);
        rays.push_back({origin, at - origin});
    }
    EXPECT_GT(compareWithBruteForce(triangles, rays), 300);
}

}  // namespace
}  // namespace licht
