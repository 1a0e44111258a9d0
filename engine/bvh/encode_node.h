#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "licht/bvh/bvh.h"

namespace licht {

/// A child before it is written into a node.
struct NodeChild {
    Bounds bounds;            ///< empty: no ray meets it (a triangle that a refit left out)
    std::uint32_t index = 0;  ///< of a node; or position in the leaves' order of the one triangle
    bool leaf = false;
};

/// Puts children into the order that a node wants: nodes first, along the axis on which their centres spread
/// most, then triangles. Whoever numbers nodes and leaves does so in this order.
void arrangeChildren(std::span<NodeChild> children);

/// Writes a node of at most kBvhWidth children. Nodes come first and have consecutive indices, then triangles
/// at consecutive positions; indices and positions are below kBvhMostTriangles.
BvhNode encodeNode(std::span<const NodeChild> children);

/// Reads a node's children into the front of the array and returns how many there are, slots in order. Their
/// boxes are those that a traversal sees, up to the slack that it allows for rounding.
std::size_t decodeNode(const BvhNode& node, std::array<NodeChild, kBvhWidth>& children);

/// The same node in a longer list: its children's indices and positions are moved.
BvhNode movedNode(const BvhNode& node, std::uint32_t nodes, std::uint32_t positions);

/// The box that the node's grid spans; at least its children's.
Bounds nodeBounds(const BvhNode& node);

/// nodeBounds() of a node whose children fill exactly these bounds.
Bounds gridBounds(const Bounds& bounds);

}  // namespace licht
