// The tree itself: every triangle in one leaf, boxes that hold what is below them, bounded depth, honest
// max_stack.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <vector>

#include "bvh_meshes.h"
#include "licht/bvh/bvh.h"

namespace licht {
namespace {

using test::Random;
using test::soup;

bool holds(const Bounds& outer, const Bounds& inner) {
    return glm::all(glm::lessThanEqual(outer.lower, inner.lower)) &&
           glm::all(glm::greaterThanEqual(outer.upper, inner.upper));
}

Bounds childBounds(const BvhNode& node, glm::length_t slot) {
    return {{node.lower_x[slot], node.lower_y[slot], node.lower_z[slot]},
            {node.upper_x[slot], node.upper_y[slot], node.upper_z[slot]}};
}

/// Walks the whole tree and checks it; returns its levels.
std::uint32_t checkNode(const Bvh& bvh, std::span<const BvhTriangle> triangles, std::uint32_t index,
                        const Bounds& limit, std::vector<int>& seen) {
    const BvhNode& node = bvh.nodes.at(index);
    std::uint32_t deepest = 0;
    for (glm::length_t slot = 0; slot < 4; ++slot) {
        const std::uint32_t child = node.child[slot];
        const Bounds bounds = childBounds(node, slot);
        if (child == kBvhNoChild) {
            EXPECT_EQ(bounds.lower, vec3(kInfinity));
            EXPECT_EQ(bounds.upper, vec3(-kInfinity));
            continue;
        }
        EXPECT_TRUE(holds(limit, bounds));
        if ((child & kBvhLeaf) == 0) {
            EXPECT_GT(child, index);  // so that no path leads back
            deepest = std::max(deepest, checkNode(bvh, triangles, child, bounds, seen));
            continue;
        }
        const std::uint32_t count = (child & ~kBvhLeaf) >> kBvhCountShift;
        EXPECT_GE(count, 1U);
        EXPECT_LE(count, kBvhMaxLeaf);
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t id = bvh.triangle_ids.at((child & kBvhFirstMask) + i);
            ++seen.at(id);
            Bounds own;
            own.extend(triangles[id].v0);
            own.extend(triangles[id].v1);
            own.extend(triangles[id].v2);
            EXPECT_TRUE(holds(bounds, own));
        }
    }
    return deepest + 1;
}

void expectValid(const Bvh& bvh, std::span<const BvhTriangle> triangles) {
    std::vector<int> seen(triangles.size(), 0);
    EXPECT_EQ(bvh.depth, checkNode(bvh, triangles, 0, bvh.bounds, seen));
    EXPECT_EQ(bvh.triangle_ids.size() + bvh.dropped, triangles.size());
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<std::ptrdiff_t>(bvh.triangle_ids.size()));
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 0), static_cast<std::ptrdiff_t>(bvh.dropped));
    // The promise of buildBvh: 2 log2(n) and a constant. Each level of four holds at least one binary level.
    const auto kept = static_cast<std::uint32_t>(std::max<std::size_t>(bvh.triangle_ids.size(), 1));
    EXPECT_LE(bvh.depth, 2 * static_cast<std::uint32_t>(std::bit_width(kept - 1)) + 8);
    EXPECT_LE(bvh.max_stack, std::max(3 * bvh.depth, 1U));
}

/// The most entries that a walk which meets every box and takes the children in the worst order ever holds.
std::uint32_t worstStack(const Bvh& bvh, std::uint32_t index) {
    const BvhNode& node = bvh.nodes[index];
    std::vector<std::uint32_t> below;
    for (glm::length_t slot = 0; slot < 4; ++slot) {
        const std::uint32_t child = node.child[slot];
        if (child != kBvhNoChild) {
            below.push_back((child & kBvhLeaf) != 0 ? 0 : worstStack(bvh, child));
        }
    }
    std::uint32_t worst = 0;
    std::sort(below.begin(), below.end());
    do {
        for (std::size_t i = 0; i < below.size(); ++i) {
            worst = std::max(worst, below[i] + static_cast<std::uint32_t>(below.size() - 1 - i));
        }
    } while (std::next_permutation(below.begin(), below.end()));
    return worst;
}

std::vector<BvhTriangle> repeated(const BvhTriangle& triangle, std::size_t count) {
    return std::vector<BvhTriangle>(count, triangle);
}

const BvhTriangle kUnit{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

TEST(BvhBuild, EmptySceneHasOneNodeWithoutChildren) {
    const Bvh bvh = buildBvh({});
    ASSERT_EQ(bvh.nodes.size(), 1U);
    EXPECT_EQ(bvh.nodes[0].child, uvec4(kBvhNoChild));
    EXPECT_TRUE(bvh.bounds.empty());
    EXPECT_GE(bvh.max_stack, 1U);
    EXPECT_FALSE(intersect(bvh, {}, Ray{}));
}

TEST(BvhBuild, TreesOfEverySmallSizeAreValid) {
    for (std::size_t count = 1; count <= 70; ++count) {
        const auto triangles = soup(count, 0.3F, static_cast<std::uint32_t>(count));
        const Bvh bvh = buildBvh(triangles);
        expectValid(bvh, triangles);
        EXPECT_EQ(bvh.max_stack, std::max(worstStack(bvh, 0), 1U)) << count;
    }
}

TEST(BvhBuild, LargeSoupIsValidAndTraversalsStayInsideTheStack) {
    const auto triangles = soup(50'000, 0.05F, 1);
    const Bvh bvh = buildBvh(triangles);
    expectValid(bvh, triangles);
    EXPECT_EQ(bvh.max_stack, worstStack(bvh, 0));
    Random random(2);
    std::uint32_t most = 0;
    for (int i = 0; i < 20'000; ++i) {
        TraversalSteps steps;
        (void)intersect(bvh, triangles, {random.inCube(1.2F), random.direction()}, &steps);
        most = std::max(most, steps.stack);
    }
    EXPECT_LE(most, bvh.max_stack);
    EXPECT_GT(most, 3U);  // the instrument counts
}

TEST(BvhBuild, SameInputSameTree) {
    const auto triangles = soup(5'000, 0.1F, 3);
    const Bvh first = buildBvh(triangles);
    const Bvh second = buildBvh(triangles);
    EXPECT_EQ(first.triangle_ids, second.triangle_ids);
    ASSERT_EQ(first.nodes.size(), second.nodes.size());
    for (std::size_t i = 0; i < first.nodes.size(); ++i) {
        EXPECT_EQ(first.nodes[i].child, second.nodes[i].child);
        EXPECT_EQ(first.nodes[i].lower_x, second.nodes[i].lower_x);
    }
}

TEST(BvhBuild, UnusableTrianglesAreDroppedAndCounted) {
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
    EXPECT_EQ(nothing.nodes[0].child, uvec4(kBvhNoChild));
    EXPECT_FALSE(intersect(nothing, bad, {{0.2F, 0.2F, 1.0F}, {0, 0, -1}}));
}

TEST(BvhBuild, TheLargestAndTheSmallestCoordinatesAreKept) {
    std::vector<BvhTriangle> triangles = soup(200, 0.1F, 5);
    for (BvhTriangle& triangle : triangles) {
        triangle = {triangle.v0 * 1.6e18F, triangle.v1 * 1.6e18F, triangle.v2 * 1.6e18F};
    }
    const auto tiny = soup(200, 0.1F, 6);
    for (const BvhTriangle& triangle : tiny) {
        triangles.push_back({triangle.v0 * 1e-18F, triangle.v1 * 1e-18F, triangle.v2 * 1e-18F});
    }
    const Bvh bvh = buildBvh(triangles);
    EXPECT_EQ(bvh.dropped, 0U);
    expectValid(bvh, triangles);
}

TEST(BvhBuild, AMillionEqualTriangles) {
    const auto triangles = repeated(kUnit, 1'000'000);
    const Bvh bvh = buildBvh(triangles);
    // Four times the triangles of an ordinary scene, ten times its seconds: any growth worse than n log n
    // (1.1 * 4) is far beyond that, whatever the machine and the compiler's settings.
    EXPECT_LT(bvh.build_seconds, 10.0 * buildBvh(soup(250'000, 0.02F, 7)).build_seconds);
    expectValid(bvh, triangles);
    const auto hit = intersect(bvh, triangles, {{0.25F, 0.25F, 2.0F}, {0, 0, -1}});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->triangle, 0U);
    EXPECT_EQ(hit->t, 2.0F);
}

TEST(BvhBuild, ASpineOfHalvesStaysShallow) {
    std::vector<BvhTriangle> triangles;
    for (int i = 0; i < 120; ++i) {
        const float scale = std::ldexp(1.0F, -i / 2);
        triangles.push_back({kUnit.v0 + scale, kUnit.v1 * scale + scale, kUnit.v2 * scale + scale});
        const float at = std::ldexp(1.0F, -i);
        triangles.push_back({vec3(at, 0, 0), vec3(at, at, 0), vec3(at, 0, at)});
    }
    const Bvh bvh = buildBvh(triangles);
    expectValid(bvh, triangles);
    EXPECT_LE(bvh.depth, 24U);  // 2 * log2(256) + 8
}

}  // namespace
}  // namespace licht
