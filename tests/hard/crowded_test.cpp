// Trees that are hard to split: a million equal triangles, sizes that halve 120 times, equal surfaces.
#include <algorithm>
#include <cmath>
#include <iostream>

#include "hard.h"

namespace licht {
namespace {

using test::Random;

constexpr BvhTriangle kUnit{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};

// unit/bvh_build_test has the tree alone, against a scene of a quarter of the size; this is the row's bound.
TEST(Crowded, AMillionEqualTrianglesBuildAndAreHit) {
    const std::vector<BvhTriangle> triangles(1'000'000, kUnit);
    test::Tracer tracer(triangles);
    const double ordinary = buildBvh(test::soup(triangles.size(), 0.01F, 1)).build_seconds;
    std::cout << "build " << tracer.bvh().build_seconds / ordinary << " of a random scene's, depth "
              << tracer.bvh().depth << '\n';
    EXPECT_LT(tracer.bvh().build_seconds, 10.0 * ordinary);
    EXPECT_LE(tracer.bvh().depth, 39U);  // 2 log2(1e6) = 39.9

    const std::vector<Ray> rays(64, Ray{{0.1F, -0.2F, 2.0F}, {0, 0, -1}});
    const auto expected = intersect(tracer.bvh(), triangles, rays[0]);
    ASSERT_TRUE(expected);
    EXPECT_EQ(expected->triangle, 0U);
    EXPECT_EQ(expected->t, 2.0F);
    const test::Hits hits = tracer.trace(rays);
    // A driver that ends long loops must be caught at it: every ray hits triangle 0 or is reported as truncated.
    int right = 0;
    for (const auto& hit : hits) {
        right += test::same(hit, expected) ? 1 : 0;
    }
    std::cout << right << " right, " << tracer.truncated() << " reported as truncated\n";
    EXPECT_EQ(right + tracer.truncated(), static_cast<int>(hits.size()));
}

// Triangles of sizes 2^59 .. 2^-60 that lie at their own distance from one corner: the products of any two
// coordinates are ordinary numbers.
TEST(Crowded, ASpineOf120HalvesFitsTheStack) {
    std::vector<BvhTriangle> triangles;
    std::vector<Ray> rays;
    Random random(3);
    for (int i = 0; i < 120; ++i) {
        const float at = std::ldexp(1.0F, 59 - i);
        triangles.push_back({{at, 0, 0}, {at, at, 0}, {at, 0, at}});
        // The largest coordinate decides a ray's rounding, so rays start as near as what they aim at.
        rays.push_back({{1.75F * at, 0.25F * at, 0.25F * at}, {-1, 0, 0}});
        rays.push_back({{-at, 0.25F * at, 0.25F * at}, {1, 0, 0}});
        for (int k = 0; k < 50; ++k) {
            rays.push_back({random.inCube(2.0F * at), random.direction()});
        }
    }
    test::Tracer tracer(triangles);  // its stack holds exactly Bvh::max_stack entries
    const test::Hits found = tracer.trace(rays);
    EXPECT_EQ(tracer.truncated(), 0);
    std::uint32_t most = 0;
    std::size_t different = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        TraversalSteps steps;
        const auto expected = intersect(tracer.bvh(), triangles, rays[i], &steps);
        EXPECT_TRUE(test::same(expected, intersectBruteForce(triangles, rays[i]))) << i;
        different += test::same(found[i], expected) ? 0U : 1U;
        most = std::max(most, steps.stack);
    }
    std::cout << "depth " << tracer.bvh().depth << ", stack " << most << " of " << tracer.bvh().max_stack
              << '\n';
    EXPECT_EQ(different, 0U);
    EXPECT_LE(most, tracer.bvh().max_stack);
    EXPECT_GT(rays.size() - test::missesOf(found), rays.size() / 10);
}

// A grazed floor in eight copies, their triangles shuffled: the lowest index wins on host and device, in
// whatever order rays stand beside each other, a hundred times.
TEST(Crowded, EqualSurfacesGoToTheSameTriangleInAnyOrder) {
    std::vector<BvhTriangle> triangles;
    for (int copy = 0; copy < 8; ++copy) {
        Random same(4);
        for (int i = 0; i < 60; ++i) {
            const auto onFloor = [&] { return vec3(same.uniform(-4, 4), 0.7F, same.uniform(-4, 4)); };
            triangles.push_back({onFloor(), onFloor(), onFloor()});
        }
    }
    Random random(5);
    std::shuffle(triangles.begin(), triangles.end(), std::mt19937(6));
    std::vector<Ray> rays;
    for (int i = 0; i < 1'024; ++i) {
        const vec3 origin = random.inCube(4.0F);
        rays.push_back({origin, vec3(random.uniform(-4, 4), 0.7F, random.uniform(-4, 4)) - origin});
    }
    test::Hits expected;
    for (const Ray& ray : rays) {
        expected.push_back(intersectBruteForce(triangles, ray));
    }
    EXPECT_LT(test::missesOf(expected), rays.size() / 4);
    test::Tracer tracer(triangles);
    std::vector<std::size_t> order(rays.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        order[i] = i;
    }
    std::mt19937 engine(7);
    std::size_t different = 0;
    for (int run = 0; run < 100; ++run) {
        std::vector<Ray> shuffled;
        test::Hits wanted;
        for (const std::size_t i : order) {
            shuffled.push_back(rays[i]);
            wanted.push_back(expected[i]);
        }
        different += test::differences(tracer.trace(shuffled), wanted);
        std::shuffle(order.begin(), order.end(), engine);
        if (run % 10 == 0) {  // another build gives the same answers
            const Bvh bvh = buildBvh(triangles);
            for (std::size_t i = 0; i < rays.size(); ++i) {
                different += test::same(intersect(bvh, triangles, rays[i]), expected[i]) ? 0U : 1U;
            }
        }
    }
    EXPECT_EQ(different, 0U);
}

}  // namespace
}  // namespace licht
