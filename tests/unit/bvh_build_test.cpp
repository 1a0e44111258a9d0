// The tree itself: every triangle in one leaf, boxes that hold what is below them, bounded depth, honest
// max_stack, the same tree each time.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <vector>

#include "bvh_checks.h"
#include "bvh_meshes.h"
#include "licht/bvh/bvh.h"
#include "licht/bvh/quality.h"

namespace licht {
namespace {

using test::childrenOf;
using test::expectEqualTrees;
using test::expectValid;
using test::Random;
using test::soup;

constexpr std::array kQualities{BvhQuality::fast, BvhQuality::balanced, BvhQuality::best};

/// The most entries that a walk which meets every box and begins with the worst child ever holds: siblings
/// that are nodes wait as one entry.
std::uint32_t worstStack(const Bvh& bvh, std::uint32_t index) {
    std::uint32_t below = 0;
    std::uint32_t nodes = 0;
    for (const NodeChild& child : childrenOf(bvh.nodes[index])) {
        if (!child.leaf) {
            below = std::max(below, worstStack(bvh, child.index));
            ++nodes;
        }
    }
    return below + (nodes > 1 ? 1 : 0);
}

TEST(BvhBuild, EmptySceneHasOneNodeWithoutChildren) {
    for (const BvhQuality quality : kQualities) {
        const Bvh bvh = buildBvh({}, {quality});
        ASSERT_EQ(bvh.nodes.size(), 1U);
        EXPECT_TRUE(childrenOf(bvh.nodes[0]).empty());
        EXPECT_TRUE(bvh.bounds.empty());
        EXPECT_GE(bvh.max_stack, 1U);
        EXPECT_EQ(bvh.depth, 1U);
        EXPECT_FALSE(intersect(bvh, {}, Ray{}));
    }
}

TEST(BvhBuild, TreesOfEverySmallSizeAreValid) {
    for (const BvhQuality quality : kQualities) {
        for (std::size_t count = 1; count <= 70; ++count) {
            const auto triangles = soup(count, 0.3F, static_cast<std::uint32_t>(count));
            const Bvh bvh = buildBvh(triangles, {quality});
            expectValid(bvh, triangles);
            EXPECT_EQ(bvh.max_stack, std::max(worstStack(bvh, 0), 1U)) << count;
        }
    }
}

TEST(BvhBuild, LargeSoupIsValidAndTraversalsStayInsideTheStack) {
    const auto triangles = soup(50'000, 0.05F, 1);
    const Bvh bvh = buildBvh(triangles);
    expectValid(bvh, triangles);
    EXPECT_EQ(bvh.max_stack, worstStack(bvh, 0));
    Random random(2);
    std::uint32_t most = 0;
    std::uint64_t nearest_nodes = 0;
    std::uint64_t any_nodes = 0;
    for (int i = 0; i < 20'000; ++i) {
        TraversalSteps steps;
        TraversalSteps any_steps;
        const Ray ray{random.inCube(1.2F), random.direction()};
        const auto nearest = intersect(bvh, triangles, ray, &steps);
        const auto any = intersect(bvh, triangles, ray, &any_steps, true);
        ASSERT_EQ(any.has_value(), nearest.has_value());
        EXPECT_LE(any_steps.nodes, steps.nodes);
        EXPECT_LE(any_steps.triangles, steps.triangles);
        most = std::max(most, steps.stack);
        nearest_nodes += steps.nodes;
        any_nodes += any_steps.nodes;
    }
    EXPECT_LE(most, bvh.max_stack);
    EXPECT_GT(most, 3U);  // the instrument counts
    EXPECT_LT(any_nodes, nearest_nodes);
}

TEST(BvhBuild, SameInputSameTreeWhateverTheNumberOfThreads) {
    const auto triangles = soup(150'000, 0.03F, 3);  // enough for the splits that all threads work on
    for (const BvhQuality quality : kQualities) {
        const auto build = [&](std::size_t threads) {
            const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
            return buildBvh(triangles, {quality});
        };
        const Bvh alone = build(1);
        expectValid(alone, triangles);
        expectEqualTrees(alone, build(2));
        expectEqualTrees(alone, build(7));
    }
}

TEST(BvhBuild, EveryQualityFindsWhatBruteForceFinds) {
    const auto triangles = soup(3'000, 0.1F, 8);
    Random random(9);
    std::vector<Ray> rays;
    for (int i = 0; i < 500; ++i) {
        rays.push_back({random.inCube(1.5F), random.direction()});
    }
    for (const BvhQuality quality : kQualities) {
        const Bvh bvh = buildBvh(triangles, {quality});
        for (const Ray& ray : rays) {
            test::expectSameHit(intersect(bvh, triangles, ray), intersectBruteForce(triangles, ray));
        }
    }
}

}  // namespace
}  // namespace licht
