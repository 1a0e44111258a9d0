// What must hold for every tree, whoever made it.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <span>
#include <vector>

#include "licht/bvh/bvh.h"
#include "licht/bvh/encode_node.h"

namespace licht::test {

inline std::vector<NodeChild> childrenOf(const BvhNode& node) {
    std::array<NodeChild, kBvhWidth> children;
    const std::size_t count = decodeNode(node, children);
    return {children.begin(), children.begin() + static_cast<std::ptrdiff_t>(count)};
}

inline Bounds boxOf(const BvhTriangle& triangle) {
    Bounds bounds;
    bounds.extend(triangle.v0);
    bounds.extend(triangle.v1);
    bounds.extend(triangle.v2);
    return bounds;
}

inline bool holds(const Bounds& outer, const Bounds& inner) {
    return inner.empty() || (glm::all(glm::lessThanEqual(outer.lower, inner.lower)) &&
                             glm::all(glm::greaterThanEqual(outer.upper, inner.upper)));
}

/// Walks a subtree: each triangle is inside the boxes of all nodes above it. Returns its levels; `below`
/// becomes the box of its triangles.
inline std::uint32_t checkNode(const Bvh& bvh, std::span<const BvhTriangle> triangles, std::uint32_t index,
                               Bounds& below, std::vector<int>& seen) {
    std::uint32_t deepest = 0;
    for (const NodeChild& child : childrenOf(bvh.nodes.at(index))) {
        Bounds inside;
        if (child.leaf) {
            const std::uint32_t id = bvh.triangle_ids.at(child.index);
            ++seen.at(id);
            inside = boxOf(triangles[id]);
        } else {
            EXPECT_GT(child.index, index);  // so that no path leads back
            deepest = std::max(deepest, checkNode(bvh, triangles, child.index, inside, seen));
        }
        EXPECT_TRUE(holds(child.bounds, inside));
        below.extend(inside);
    }
    return deepest + 1;
}

inline void expectValid(const Bvh& bvh, std::span<const BvhTriangle> triangles) {
    std::vector<int> seen(triangles.size(), 0);
    Bounds all;
    EXPECT_EQ(bvh.depth, checkNode(bvh, triangles, 0, all, seen));
    EXPECT_EQ(bvh.bounds.lower, all.lower);
    EXPECT_EQ(bvh.bounds.upper, all.upper);
    EXPECT_EQ(bvh.input_triangles, triangles.size());
    EXPECT_EQ(bvh.triangle_ids.size() + bvh.dropped, triangles.size());
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<std::ptrdiff_t>(bvh.triangle_ids.size()));
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 0), static_cast<std::ptrdiff_t>(bvh.dropped));
    // The promise of buildBvh: 2 log2(n) and a constant. Each wide level holds at least one binary level.
    const auto kept = static_cast<std::uint32_t>(std::max<std::size_t>(bvh.triangle_ids.size(), 1));
    EXPECT_LE(bvh.depth, std::max(2 * static_cast<std::uint32_t>(std::bit_width(kept - 1)) + 8, 1U));
    EXPECT_LE(bvh.max_stack, bvh.depth);
}

inline void expectEqualTrees(const Bvh& a, const Bvh& b) {
    EXPECT_EQ(a.triangle_ids, b.triangle_ids);
    ASSERT_EQ(a.nodes.size(), b.nodes.size());
    using Words = std::array<std::uint32_t, sizeof(BvhNode) / sizeof(std::uint32_t)>;
    std::uint32_t different = 0;
    for (std::size_t i = 0; i < a.nodes.size(); ++i) {
        different += std::bit_cast<Words>(a.nodes[i]) != std::bit_cast<Words>(b.nodes[i]) ? 1U : 0U;
    }
    EXPECT_EQ(different, 0U);
    EXPECT_EQ(a.depth, b.depth);
    EXPECT_EQ(a.max_stack, b.max_stack);
    EXPECT_EQ(a.sah_cost, b.sah_cost);
}

inline void expectSameHit(const std::optional<BvhHit>& a, const std::optional<BvhHit>& b) {
    ASSERT_EQ(a.has_value(), b.has_value());
    if (a) {
        EXPECT_EQ(a->triangle, b->triangle);
        EXPECT_EQ(a->t, b->t);
        EXPECT_EQ(a->b1, b->b1);
        EXPECT_EQ(a->b2, b->b2);
    }
}

}  // namespace licht::test
