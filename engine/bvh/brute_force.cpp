#include "licht/bvh/ray_setup.h"

namespace licht {

std::optional<BvhHit> intersectBruteForce(std::span<const BvhTriangle> triangles, const Ray& ray) {
    Bounds bounds;
    for (const BvhTriangle& triangle : triangles) {
        if (isUsable(triangle)) {
            bounds.extend(boundsOf(triangle));
        }
    }
    const std::optional<RaySetup> setup = setUpRay(ray, bounds);
    if (!setup) {
        return std::nullopt;
    }
    std::optional<BvhHit> nearest;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        if (!isUsable(triangles[i])) {
            continue;
        }
        const std::optional<TriangleHit> hit = testTriangle(*setup, triangles[i]);
        if (hit && hit->t >= ray.t_min && hit->t < (nearest ? nearest->t : ray.t_max)) {
            nearest = BvhHit{i, hit->t, hit->b1, hit->b2};
        }
    }
    return nearest;
}

}  // namespace licht
