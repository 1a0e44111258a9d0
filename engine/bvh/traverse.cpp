// The algorithm of shaders/ray/traversal.glsl, one ray at a time: the same nodes in the same order.
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <vector>

#include "licht/bvh/encode_node.h"
#include "licht/bvh/ray_setup.h"
#include "licht/shared/bvh_numerics.h"

namespace licht {
namespace {

/// A node's children that are nodes and wait, and from which end they are taken.
struct Group {
    std::uint32_t child_base = 0;
    std::uint32_t slots = 0;  ///< bits
    bool reversed = false;

    std::uint32_t take() {
        std::uint32_t slot = reversed ? kBvhWidth - 1 : 0;
        while ((slots >> slot & 1U) == 0) slot = reversed ? slot - 1 : slot + 1;
        slots &= ~(1U << slot);
        return child_base + slot;
    }
};

/// The children whose boxes a ray meets.
struct Met {
    std::uint32_t nodes = 0;  ///< bits of slots
    std::uint32_t nearest = 0;
    std::array<std::uint32_t, kBvhWidth> triangles{};  ///< positions in the leaves' order
    std::size_t triangle_count = 0;
};

class BoxTest {
public:
    BoxTest(const Ray& ray, const RaySetup& setup) : origin_(ray.origin), t_min_(setup.t_min) {
        for (int i = 0; i < 3; ++i) {
            const int axis = setup.axis[static_cast<std::size_t>(i)];
            reciprocal_[axis] = i == 2 ? setup.shear.z : setup.reciprocal[i];
            slack_[axis] = i == 2 ? 0.0F : setup.slack[i];
        }
    }

    [[nodiscard]] bool negative(std::uint32_t axis) const {
        return reciprocal_[static_cast<int>(axis)] < 0.0F;
    }

    [[nodiscard]] Met childrenMet(const BvhNode& node, float reach) const {
        std::array<NodeChild, kBvhWidth> children;
        const std::size_t count = decodeNode(node, children);
        const Bounds grid = nodeBounds(node);
        Met met;
        float nearest = kInfinity;
        for (std::uint32_t slot = 0; slot < count; ++slot) {
            const NodeChild& child = children[slot];
            float enter = t_min_;
            float leave = reach;
            for (int axis = 0; axis < 3; ++axis) {
                const float slack = slack_[axis] + kBvhPlaneSlack * distance(axis, grid);
                const float lower = (child.bounds.lower[axis] - origin_[axis]) * reciprocal_[axis];
                const float upper = (child.bounds.upper[axis] - origin_[axis]) * reciprocal_[axis];
                enter = std::max(enter, std::min(lower, upper) - slack);
                leave = std::min(leave, std::max(lower, upper) + slack);
            }
            if (child.bounds.empty() || enter > leave) continue;
            if (child.leaf) {
                met.triangles[met.triangle_count++] = child.index;
                continue;
            }
            met.nodes |= 1U << slot;
            if (enter < nearest) {
                nearest = enter;
                met.nearest = slot;
            }
        }
        return met;
    }

private:
    /// |B| + 255 |A| of kBvhPlaneSlack.
    [[nodiscard]] float distance(int axis, const Bounds& grid) const {
        return (std::abs(grid.lower[axis] - origin_[axis]) + (grid.upper[axis] - grid.lower[axis])) *
               std::abs(reciprocal_[axis]);
    }

    vec3 origin_;
    vec3 reciprocal_{};
    vec3 slack_{};
    float t_min_;
};

}  // namespace

std::optional<BvhHit> intersect(const Bvh& bvh, std::span<const BvhTriangle> triangles, const Ray& ray,
                                TraversalSteps* steps, bool any_hit) {
    const std::optional<RaySetup> setup = setUpRay(ray, nodeBounds(bvh.nodes.front()));
    if (!setup) {
        return std::nullopt;
    }
    const BoxTest boxes(ray, *setup);
    NearestHit nearest(*setup);
    TraversalSteps counted;
    std::vector<Group> waiting;
    waiting.reserve(bvh.max_stack);
    std::uint32_t current = 0;
    const auto enough = [&] { return any_hit && nearest.result().has_value(); };
    while (current != kBvhNone && !enough()) {
        const BvhNode& node = bvh.nodes[current];
        Met met = boxes.childrenMet(node, nearest.reach());
        ++counted.nodes;
        for (std::size_t i = 0; i < met.triangle_count && !enough(); ++i) {
            ++counted.triangles;
            const std::uint32_t id = bvh.triangle_ids[met.triangles[i]];
            if (const std::optional<TriangleHit> hit = testTriangle(*setup, triangles[id])) {
                nearest.offer(id, *hit);
            }
        }

        // The nearest child first, the others along the axis on which they are sorted.
        current = kBvhNone;
        if (met.nodes != 0) {
            std::array<NodeChild, kBvhWidth> children;
            decodeNode(node, children);
            current = children[met.nearest].index;
            const std::uint32_t rest = met.nodes & ~(1U << met.nearest);
            if (rest != 0) {
                waiting.push_back({children[0].index, rest, boxes.negative(node.head >> kBvhAxisShift)});
                counted.stack = std::max(counted.stack, static_cast<std::uint32_t>(waiting.size()));
            }
        } else if (!waiting.empty()) {
            current = waiting.back().take();
            if (waiting.back().slots == 0) waiting.pop_back();
        }
    }
    assert(counted.stack <= bvh.max_stack);
    if (steps != nullptr) {
        *steps = counted;
    }
    return nearest.result();
}

std::optional<BvhHit> intersect(const Bvh& bvh, std::span<const BvhTriangle> triangles, const Ray& ray) {
    return intersect(bvh, triangles, ray, nullptr);
}

}  // namespace licht
