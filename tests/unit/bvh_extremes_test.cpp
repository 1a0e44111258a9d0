// Triangles that builders stumble over: garbage, a million equal ones, sizes from 1 to 2^-119.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "bvh_checks.h"
#include "bvh_meshes.h"
#include "licht/bvh/bvh.h"

namespace licht {
namespace {

using test::expectValid;
using test::soup;

const BvhTriangle kUnit{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

TEST(BvhExtremes, UnusableTrianglesAreDroppedAndCounted) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::vector<BvhTriangle> triangles = soup(10, 0.3F, 4);
    const std::vector<BvhTriangle> bad{
        {{nan, 0, 0}, {1, 0, 0}, {0, 1, 0}},        {{0, 0, 0}, {1, kInfinity, 0}, {0, 1, 0}},
        {{0, 0, 0}, {1, 0, 0}, {0, 1, -kInfinity}}, {{0, 0, 0}, {1e30F, 0, 0}, {0, 1, 0}},
        {{1, 2, 3}, {1, 2, 3}, {4, 5, 6}},          {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}},
    };
    triangles.insert(triangles.begin() + 5, bad.begin(), bad.end());
    const Bvh bvh = buildBvh(triangles);
    EXPECT_EQ(bvh.dropped, bad.size());
    expectValid(bvh, triangles);

    const Bvh nothing = buildBvh(bad);
    EXPECT_EQ(nothing.dropped, bad.size());
    EXPECT_TRUE(test::childrenOf(nothing.nodes[0]).empty());
    EXPECT_FALSE(intersect(nothing, bad, {{0.2F, 0.2F, 1.0F}, {0, 0, -1}}));
}

TEST(BvhExtremes, DroppedTrianglesLeaveNoGapsAnywhere) {
    // Several of the blocks that the threads share out, one of them without a single usable triangle.
    std::vector<BvhTriangle> triangles = soup(20'000, 0.05F, 10);
    std::size_t dropped = 0;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        if (i % 7 == 3 || (i > 4'000 && i < 13'000)) {
            triangles[i].v1 = triangles[i].v0;
            ++dropped;
        }
    }
    const Bvh bvh = buildBvh(triangles);
    EXPECT_EQ(bvh.dropped, dropped);
    expectValid(bvh, triangles);
}

TEST(BvhExtremes, TheLargestAndTheSmallestCoordinatesAreKept) {
    std::vector<BvhTriangle> triangles = soup(200, 0.1F, 5);
    for (BvhTriangle& triangle : triangles) {
        triangle = {triangle.v0 * 1.6e18F, triangle.v1 * 1.6e18F, triangle.v2 * 1.6e18F};
    }
    const auto tiny = soup(200, 0.1F, 6);
    for (const BvhTriangle& triangle : tiny) {
        triangles.push_back({triangle.v0 * 1e-18F, triangle.v1 * 1e-18F, triangle.v2 * 1e-18F});
    }
    for (const BvhQuality quality : {BvhQuality::fast, BvhQuality::balanced, BvhQuality::best}) {
        const Bvh bvh = buildBvh(triangles, {quality});
        EXPECT_EQ(bvh.dropped, 0U);
        EXPECT_TRUE(std::isfinite(bvh.sah_cost));
        expectValid(bvh, triangles);
    }
}

TEST(BvhExtremes, AMillionEqualTriangles) {
    const std::vector<BvhTriangle> triangles(1'000'000, kUnit);
    const Bvh bvh = buildBvh(triangles);
    // Four times the triangles of an ordinary scene, ten times its seconds: any growth worse than n log n
    // (1.1 * 4) is far beyond that, whatever the machine and the compiler's settings.
    EXPECT_LT(bvh.build_seconds, 10.0 * buildBvh(soup(250'000, 0.02F, 7)).build_seconds);
    expectValid(bvh, triangles);
    EXPECT_LE(bvh.depth, 40U);  // 2 log2(n); halves of equal count would make it 20 at most
    const auto hit = intersect(bvh, triangles, {{0.25F, 0.25F, 2.0F}, {0, 0, -1}});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->triangle, 0U);
    EXPECT_EQ(hit->t, 2.0F);
}

/// Each half the size of the one before and half as far out: the cheapest tree by area cuts off one after the
/// other.
std::vector<BvhTriangle> spine(int count) {
    std::vector<BvhTriangle> triangles;
    for (int i = 0; i < count; ++i) {
        const float at = std::ldexp(1.0F, -i);
        triangles.push_back({vec3(at, 0, 0), vec3(at, at, 0), vec3(at, 0, at)});
    }
    return triangles;
}

TEST(BvhExtremes, ASpineOfHalvesStaysShallow) {
    for (const int count : {50, 120}) {
        for (const BvhQuality quality : {BvhQuality::fast, BvhQuality::balanced, BvhQuality::best}) {
            const auto triangles = spine(count);
            const Bvh bvh = buildBvh(triangles, {quality});
            EXPECT_EQ(bvh.dropped, 0U);
            expectValid(bvh, triangles);  // with the bound on the depth
        }
    }
}

TEST(BvhExtremes, SpinesAmongOtherTrianglesStayShallow) {
    std::vector<BvhTriangle> triangles = spine(120);
    for (int i = 0; i < 120; ++i) {
        const float scale = std::ldexp(1.0F, -i / 2);
        triangles.push_back({kUnit.v0 + scale, kUnit.v1 * scale + scale, kUnit.v2 * scale + scale});
    }
    for (const BvhTriangle& triangle : soup(1'000, 0.01F, 11)) {
        triangles.push_back(triangle);
    }
    for (const BvhQuality quality : {BvhQuality::fast, BvhQuality::balanced, BvhQuality::best}) {
        const Bvh bvh = buildBvh(triangles, {quality});
        EXPECT_EQ(bvh.dropped, 0U);
        expectValid(bvh, triangles);
    }
}

}  // namespace
}  // namespace licht
