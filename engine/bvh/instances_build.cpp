#include <algorithm>
#include <array>
#include <cmath>

#include "licht/bvh/instances.h"
#include "licht/core/clock.h"
#include "licht/shared/bvh_numerics.h"

namespace licht {
namespace {

/// The usable triangles' vertices, each once.
std::vector<vec3> usedPoints(const Bvh& bvh, std::span<const BvhTriangle> triangles) {
    std::vector<vec3> points;
    points.reserve(3 * bvh.triangle_ids.size());
    for (const std::uint32_t id : bvh.triangle_ids) {
        points.insert(points.end(), {triangles[id].v0, triangles[id].v1, triangles[id].v2});
    }
    std::sort(points.begin(), points.end(), [](const vec3& a, const vec3& b) {
        return a.x != b.x ? a.x < b.x : (a.y != b.y ? a.y < b.y : a.z < b.z);
    });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
}

}  // namespace

TwoLevelBvh buildTwoLevelBvh(std::span<const BvhTriangle> baked,
                             std::span<const std::vector<BvhTriangle>> meshes,
                             std::vector<BvhInstance> instances, const BvhBuildOptions& options) {
    const Clock::time_point start = Clock::now();
    TwoLevelBvh tree;
    tree.baked = buildBvh(baked, options);
    std::vector<std::vector<vec3>> points;
    for (const std::vector<BvhTriangle>& mesh : meshes) {
        tree.meshes.push_back(buildBvh(mesh, options));
        points.push_back(usedPoints(tree.meshes.back(), mesh));
    }
    tree.instances = std::move(instances);
    float condition = 0.0F;
    for (std::uint32_t i = 0; i < tree.instances.size(); ++i) {
        const BvhInstance& instance = tree.instances[i];
        if (points[instance.mesh].empty()) {
            continue;
        }
        const Bounds bounds = instanceBounds(instance, points[instance.mesh]);
        tree.top_bounds.extend(bounds);
        tree.top_boxes.push_back(bounds);
        tree.top_ids.push_back(i);
        condition = std::max(condition, instance.condition);
    }
    tree.slack = kInstanceSlack * condition;
    tree.top = buildBinary(tree.top_boxes);
    tree.build_seconds = secondsSince(start);
    return tree;
}

}  // namespace licht
