#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "licht/bvh/encode_node.h"
#include "licht/bvh/instances.h"
#include "licht/bvh/ray_setup.h"
#include "licht/shared/bvh_numerics.h"

namespace licht {
namespace {

/// Whether a ray meets boxes that are widened on every axis by what going to object space can move it.
class WidenedBoxTest {
public:
    WidenedBoxTest(const Ray& ray, const Bounds& bounds, float slack)
        : origin_(ray.origin), t_min_(ray.t_min) {
        const std::optional<RaySetup> setup = setUpRay(ray, gridBounds(bounds));
        valid_ = setup.has_value();
        if (!valid_) return;
        const vec3 reach = glm::max(glm::abs(bounds.lower - ray.origin), glm::abs(bounds.upper - ray.origin));
        const float moved = slack * std::max({reach.x, reach.y, reach.z});
        for (int i = 0; i < 3; ++i) {
            const int axis = setup->axis[static_cast<std::size_t>(i)];
            reciprocal_[axis] = (i == 2 ? setup->shear.z : setup->reciprocal[i]) / setup->distance_scale;
            slack_[axis] =
                moved + std::abs(ray.origin[axis]) * kBvhOriginSlack +
                (i == 2 ? 0.0F : setup->slack[i] / setup->distance_scale / std::abs(reciprocal_[axis]));
        }
    }

    [[nodiscard]] bool valid() const { return valid_; }

    [[nodiscard]] bool meets(const Bounds& box, float t_max) const {
        float enter = t_min_;
        float leave = t_max;
        for (int axis = 0; axis < 3; ++axis) {
            const float a = (box.lower[axis] - slack_[axis] - origin_[axis]) * reciprocal_[axis];
            const float b = (box.upper[axis] + slack_[axis] - origin_[axis]) * reciprocal_[axis];
            enter = std::max(enter, std::min(a, b));
            leave = std::min(leave, std::max(a, b));
        }
        return enter <= leave;
    }

private:
    vec3 origin_;
    vec3 reciprocal_{};
    vec3 slack_{};
    float t_min_;
    bool valid_ = false;
};

/// Ties: baked first, then by instance, then by triangle.
auto order(const TwoLevelHit& h) {
    return std::tuple(h.hit.t, h.instance + 1U, h.hit.triangle);
}

void keepNearer(std::optional<TwoLevelHit>& best, std::uint32_t instance, const std::optional<BvhHit>& hit) {
    if (hit && (!best || order({instance, *hit}) < order(*best))) {
        best = TwoLevelHit{instance, *hit};
    }
}

/// The part of the ray in which a hit can still be the best: up to and with the best so far, for ties.
Ray shortened(Ray ray, const std::optional<TwoLevelHit>& best) {
    if (best) {
        ray.t_max = std::min(ray.t_max, std::nextafter(best->hit.t, kInfinity));
    }
    return ray;
}

}  // namespace

std::optional<TwoLevelHit> intersect(const TwoLevelBvh& tree, std::span<const BvhTriangle> baked,
                                     std::span<const std::vector<BvhTriangle>> meshes, const Ray& ray) {
    std::optional<TwoLevelHit> best;
    keepNearer(best, kBakedInstance, intersect(tree.baked, baked, ray));
    std::vector<std::uint32_t> stack;
    const Bounds bounds = tree.top.empty() ? Bounds{} : tree.top_bounds;
    const WidenedBoxTest boxes(ray, bounds, tree.slack);
    if (!tree.top.empty() && boxes.valid()) {
        stack.push_back(0);
    }
    while (!stack.empty()) {
        const BinaryNode& node = tree.top[stack.back()];
        stack.pop_back();
        const Ray rest = shortened(ray, best);
        if (!boxes.meets(node.box().bounds(), rest.t_max)) {
            continue;
        }
        if (!node.isLeaf()) {
            stack.insert(stack.end(), {node.left, node.right});
            continue;
        }
        const std::uint32_t instance = tree.top_ids[node.left];
        const std::uint32_t mesh = tree.instances[instance].mesh;
        keepNearer(best, instance,
                   intersect(tree.meshes[mesh], meshes[mesh], objectRay(tree.instances[instance], rest)));
    }
    return best;
}

std::optional<TwoLevelHit> intersectBruteForce(std::span<const BvhInstance> instances,
                                               std::span<const BvhTriangle> baked,
                                               std::span<const std::vector<BvhTriangle>> meshes,
                                               const Ray& ray) {
    std::optional<TwoLevelHit> best;
    if (!setUpRay(ray, Bounds{ray.origin, ray.origin})) {
        return best;  // what is no ray in the world is none in any object either
    }
    keepNearer(best, kBakedInstance, intersectBruteForce(baked, ray));
    for (std::uint32_t i = 0; i < instances.size(); ++i) {
        keepNearer(best, i, intersectBruteForce(meshes[instances[i].mesh], objectRay(instances[i], ray)));
    }
    return best;
}

}  // namespace licht
