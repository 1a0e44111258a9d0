#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "licht/bvh/bvh.h"

namespace licht {

/// A triangle as the builder sees it.
struct BuildReference {
    vec3 lower;
    vec3 upper;
    std::uint32_t id;
};

/// Covers the references [first, first + count).
struct BinaryNode {
    Bounds bounds;
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    std::uint32_t left = 0;  ///< index of the left child, the right one follows it; 0: a leaf
};

/// Sorts the references into the leaves' order and returns the nodes, the root first. There must be at least
/// one reference.
std::vector<BinaryNode> buildBinary(std::span<BuildReference> references);

/// Appends the 4-wide tree of a binary one (empty: a root without children) to bvh.nodes and sets bvh.depth
/// and bvh.max_stack.
void collapse(std::span<const BinaryNode> binary, Bvh& bvh);

}  // namespace licht
