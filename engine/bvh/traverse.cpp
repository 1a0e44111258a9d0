// The algorithm of shaders/bound/traversal.glsl: the same nodes and triangles in the same order.
#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

#include "licht/bvh/ray_setup.h"
#include "licht/shared/bvh_numerics.h"

namespace licht {
namespace {

// Three waiting siblings for each of the levels that the builder can make of kBvhFirstMask triangles: 2 * 28
// + 8.
constexpr std::size_t kStackSize = std::size_t{3} * 64;

constexpr std::array<vec4 BvhNode::*, 6> kPlanes{&BvhNode::lower_x, &BvhNode::upper_x, &BvhNode::lower_y,
                                                 &BvhNode::upper_y, &BvhNode::lower_z, &BvhNode::upper_z};

struct Entry {
    float distance = kInfinity;
    std::uint32_t child = kBvhNoChild;
};

void order(Entry& a, Entry& b) {
    if (b.distance < a.distance) {
        std::swap(a, b);
    }
}

/// The children whose boxes the ray meets in [t_min, t_max], nearest first.
std::array<Entry, 4> childrenMet(const RaySetup& ray, const BvhNode& node, float t_min, float t_max) {
    vec4 nearest(t_min);
    vec4 farthest(kInfinity);
    for (std::size_t i = 0; i < 3; ++i) {
        const auto axis = static_cast<glm::length_t>(i);
        const std::size_t plane = static_cast<std::size_t>(ray.axis[i]) * 2;
        const vec4& near_plane = node.*kPlanes[ray.negative[i] ? plane + 1 : plane];
        const vec4& far_plane = node.*kPlanes[ray.negative[i] ? plane : plane + 1];
        nearest = glm::max(nearest, (near_plane - ray.origin_near[axis]) * ray.reciprocal[axis]);
        farthest = glm::min(farthest, (far_plane - ray.origin_far[axis]) * ray.reciprocal[axis]);
    }
    farthest = glm::min(glm::max(farthest * kBvhFarWider, farthest * kBvhFarNarrower), vec4(t_max));

    std::array<Entry, 4> met;
    for (std::size_t i = 0; i < 4; ++i) {
        const auto slot = static_cast<glm::length_t>(i);
        if (nearest[slot] <= farthest[slot]) {
            met[i] = {nearest[slot], node.child[slot]};
        }
    }
    order(met[0], met[1]);
    order(met[2], met[3]);
    order(met[0], met[2]);
    order(met[1], met[3]);
    order(met[1], met[2]);
    return met;
}

}  // namespace

std::optional<BvhHit> intersect(const Bvh& bvh, std::span<const BvhTriangle> triangles, const Ray& ray,
                                TraversalSteps* steps) {
    const std::optional<RaySetup> setup = setUpRay(ray, bvh.bounds);
    if (!setup) {
        return std::nullopt;
    }
    assert(bvh.max_stack <= kStackSize);
    std::array<std::uint32_t, kStackSize> stack;
    std::uint32_t stacked = 0;
    TraversalSteps counted;
    std::optional<BvhHit> best;
    std::uint32_t current = 0;
    while (true) {
        std::uint32_t next = kBvhNoChild;
        if ((current & kBvhLeaf) == 0) {
            ++counted.nodes;
            const std::array<Entry, 4> met =
                childrenMet(*setup, bvh.nodes[current], ray.t_min, best ? best->t : ray.t_max);
            for (std::size_t i = 3; i > 0; --i) {
                if (met[i].child != kBvhNoChild) {
                    stack[stacked++] = met[i].child;
                }
            }
            counted.stack = std::max(counted.stack, stacked);
            next = met[0].child;
        } else {
            const std::uint32_t first = current & kBvhFirstMask;
            const std::uint32_t count = (current & ~kBvhLeaf) >> kBvhCountShift;
            counted.triangles += count;
            for (std::uint32_t position = first; position < first + count; ++position) {
                const std::uint32_t id = bvh.triangle_ids[position];
                const std::optional<TriangleHit> hit = testTriangle(*setup, triangles[id]);
                if (!hit || !(hit->t >= ray.t_min && hit->t < ray.t_max)) {
                    continue;
                }
                if (!best || hit->t < best->t || (hit->t == best->t && id < best->triangle)) {
                    best = BvhHit{id, hit->t, hit->b1, hit->b2};
                }
            }
        }
        if (next == kBvhNoChild) {
            if (stacked == 0) {
                break;
            }
            next = stack[--stacked];
        }
        current = next;
    }
    if (steps != nullptr) {
        *steps = counted;
    }
    return best;
}

std::optional<BvhHit> intersect(const Bvh& bvh, std::span<const BvhTriangle> triangles, const Ray& ray) {
    return intersect(bvh, triangles, ray, nullptr);
}

}  // namespace licht
