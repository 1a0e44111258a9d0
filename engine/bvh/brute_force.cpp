#include "licht/bvh/encode_node.h"
#include "licht/bvh/ray_setup.h"

namespace licht {

std::optional<BvhHit> intersectBruteForce(std::span<const BvhTriangle> triangles, const Ray& ray) {
    Bounds bounds;
    for (const BvhTriangle& triangle : triangles) {
        if (isUsable(triangle)) {
            bounds.extend(boundsOf(triangle));
        }
    }
    const std::optional<RaySetup> setup = setUpRay(ray, gridBounds(bounds));
    if (!setup) {
        return std::nullopt;
    }
    NearestHit nearest(*setup);
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        if (!isUsable(triangles[i])) {
            continue;
        }
        if (const std::optional<TriangleHit> hit = testTriangle(*setup, triangles[i])) {
            nearest.offer(i, *hit);
        }
    }
    return nearest.result();
}

}  // namespace licht
