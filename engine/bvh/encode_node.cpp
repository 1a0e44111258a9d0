#include "licht/bvh/encode_node.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

namespace licht {
namespace {

constexpr float kLastPlane = kBvhLastPlane;

/// Steps of a node's grid, powers of two.
struct Grid {
    vec3 origin{0.0F};
    std::array<std::uint32_t, 3> exponent{};  ///< biased, as in a float

    [[nodiscard]] float step(int axis) const {
        return std::bit_cast<float>(exponent[static_cast<std::size_t>(axis)] << 23U);
    }
};

Grid gridOf(const Bounds& bounds) {
    Grid grid;
    if (bounds.empty()) return grid;
    grid.origin = bounds.lower;
    for (int axis = 0; axis < 3; ++axis) {
        // The smallest power of two above a 255th of the extent; no finer than floats are there.
        const double extent =
            static_cast<double>(bounds.upper[axis]) - static_cast<double>(bounds.lower[axis]);
        const double coordinate = std::max(std::abs(bounds.lower[axis]), std::abs(bounds.upper[axis]));
        int exponent = 0;
        std::frexp(std::max(extent / kBvhLastPlane, coordinate * 0x1p-24), &exponent);
        grid.exponent[static_cast<std::size_t>(axis)] =
            static_cast<std::uint32_t>(std::clamp(exponent + 127, 1, 254));
    }
    return grid;
}

Bounds boundsOf(const Grid& grid) {
    const vec3 extent(kLastPlane * grid.step(0), kLastPlane * grid.step(1), kLastPlane * grid.step(2));
    return {grid.origin, grid.origin + extent};
}

Grid gridOf(const BvhNode& node) {
    return {node.origin, {node.head & 0xffU, node.head >> 8U & 0xffU, node.head >> 16U & 0xffU}};
}

uvec4& planesOf(BvhNode& node, int axis) {
    return axis == 0 ? node.planes_x : (axis == 1 ? node.planes_y : node.planes_z);
}

const uvec4& planesOf(const BvhNode& node, int axis) {
    return axis == 0 ? node.planes_x : (axis == 1 ? node.planes_y : node.planes_z);
}

/// Byte `index` of the first (lower planes, child_base) or second half.
std::uint32_t byteOf(const uvec4& planes, std::size_t half, std::size_t index) {
    return planes[static_cast<glm::length_t>(2 * half + index / 4)] >> 8U * (index % 4) & 0xffU;
}

void setByte(uvec4& planes, std::size_t half, std::size_t index, std::uint32_t byte) {
    std::uint32_t& word = planes[static_cast<glm::length_t>(2 * half + index / 4)];
    word = (word & ~(0xffU << 8U * (index % 4))) | byte << 8U * (index % 4);
}

std::uint32_t baseOf(const BvhNode& node, std::size_t half) {
    std::uint32_t base = 0;
    for (int axis = 0; axis < 3; ++axis)
        base |= byteOf(planesOf(node, axis), half, kBvhWidth) << 8U * static_cast<unsigned>(axis);
    return base;
}

void setBase(BvhNode& node, std::size_t half, std::uint32_t base) {
    assert(base < kBvhMostTriangles);
    for (int axis = 0; axis < 3; ++axis)
        setByte(planesOf(node, axis), half, kBvhWidth, base >> 8U * static_cast<unsigned>(axis) & 0xffU);
}

/// Twice the centre; zero for an empty box.
float centre2(const Bounds& bounds, int axis) {
    return bounds.empty() ? 0.0F : bounds.lower[axis] + bounds.upper[axis];
}

int spreadAxis(std::span<const NodeChild> nodes) {
    int widest = 0;
    float most = -1.0F;
    for (int axis = 0; axis < 3; ++axis) {
        float lower = kInfinity;
        float upper = -kInfinity;
        for (const NodeChild& child : nodes) {
            lower = std::min(lower, centre2(child.bounds, axis));
            upper = std::max(upper, centre2(child.bounds, axis));
        }
        if (upper - lower > most) {
            most = upper - lower;
            widest = axis;
        }
    }
    return widest;
}

std::span<const NodeChild> nodesAmong(std::span<const NodeChild> children) {
    const auto nodes =
        std::find_if(children.begin(), children.end(), [](const NodeChild& c) { return c.leaf; });
    return children.first(static_cast<std::size_t>(nodes - children.begin()));
}

}  // namespace

void arrangeChildren(std::span<NodeChild> children) {
    std::stable_partition(children.begin(), children.end(),
                          [](const NodeChild& child) { return !child.leaf; });
    const std::size_t count = nodesAmong(children).size();
    const int axis = spreadAxis(nodesAmong(children));
    std::stable_sort(children.begin(), children.begin() + static_cast<std::ptrdiff_t>(count),
                     [axis](const NodeChild& a, const NodeChild& b) {
                         return centre2(a.bounds, axis) < centre2(b.bounds, axis);
                     });
}

BvhNode encodeNode(std::span<const NodeChild> children) {
    assert(children.size() <= kBvhWidth);
    Bounds bounds;
    for (const NodeChild& child : children) bounds.extend(child.bounds);
    const Grid grid = gridOf(bounds);
    const std::span<const NodeChild> nodes = nodesAmong(children);

    BvhNode node{};
    node.origin = grid.origin;
    node.head = grid.exponent[0] | grid.exponent[1] << 8U | grid.exponent[2] << 16U |
                static_cast<std::uint32_t>(nodes.size()) << kBvhNodeCountShift |
                static_cast<std::uint32_t>(children.size()) << kBvhCountShift |
                static_cast<std::uint32_t>(spreadAxis(nodes)) << kBvhAxisShift;
    for (std::size_t slot = 0; slot < children.size(); ++slot) {
        const Bounds& box = children[slot].bounds;
        assert(children[slot].leaf == (slot >= nodes.size()));
        assert(children[slot].index == children[slot < nodes.size() ? 0 : nodes.size()].index + slot -
                                           (slot < nodes.size() ? 0 : nodes.size()));
        for (int axis = 0; axis < 3; ++axis) {
            const double step = grid.step(axis);
            const auto origin = static_cast<double>(grid.origin[axis]);
            const auto plane = [](double q) {
                return static_cast<std::uint32_t>(std::clamp(q, 0.0, double{kBvhLastPlane}));
            };
            uvec4& planes = planesOf(node, axis);
            setByte(
                planes, 0, slot,
                box.empty() ? kBvhLastPlane : plane(std::floor((double{box.lower[axis]} - origin) / step)));
            setByte(planes, 1, slot,
                    box.empty() ? 0 : plane(std::ceil((double{box.upper[axis]} - origin) / step)));
        }
    }
    setBase(node, 0, nodes.empty() ? 0 : nodes.front().index);
    setBase(node, 1, nodes.size() == children.size() ? 0 : children[nodes.size()].index);
    return node;
}

std::size_t decodeNode(const BvhNode& node, std::array<NodeChild, kBvhWidth>& children) {
    const std::uint32_t nodes = node.head >> kBvhNodeCountShift & 7U;
    const std::uint32_t count = node.head >> kBvhCountShift & 7U;
    const Grid grid = gridOf(node);
    for (std::uint32_t slot = 0; slot < count; ++slot) {
        NodeChild& child = children[slot];
        child.leaf = slot >= nodes;
        child.index = child.leaf ? baseOf(node, 1) + slot - nodes : baseOf(node, 0) + slot;
        child.bounds = {};
        bool empty = false;
        Bounds box;
        for (int axis = 0; axis < 3; ++axis) {
            const std::uint32_t lower = byteOf(planesOf(node, axis), 0, slot);
            const std::uint32_t upper = byteOf(planesOf(node, axis), 1, slot);
            empty = empty || lower > upper;
            box.lower[axis] = grid.origin[axis] + static_cast<float>(lower) * grid.step(axis);
            box.upper[axis] = grid.origin[axis] + static_cast<float>(upper) * grid.step(axis);
        }
        if (!empty) child.bounds = box;
    }
    return count;
}

BvhNode movedNode(const BvhNode& node, std::uint32_t nodes, std::uint32_t positions) {
    BvhNode moved = node;
    setBase(moved, 0, baseOf(node, 0) + nodes);
    setBase(moved, 1, baseOf(node, 1) + positions);
    return moved;
}

Bounds nodeBounds(const BvhNode& node) {
    return boundsOf(gridOf(node));
}

Bounds gridBounds(const Bounds& bounds) {
    return boundsOf(gridOf(bounds));
}

}  // namespace licht
