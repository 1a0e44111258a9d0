// Woop, Benthin, Wald 2013, Watertight Ray/Triangle Intersection, without its culling and its swap of axes
// (both sides count).
#include <algorithm>

#include "licht/bvh/ray_setup.h"
#include "licht/shared/bvh_numerics.h"

namespace licht {
namespace {

/// a x b. Rounding is monotonic, so a sign is right or the value is zero; a zero is looked at again in double
/// precision, where the products are exact.
float edgeFunction(const vec2& a, const vec2& b) {
    const float value = a.x * b.y - a.y * b.x;
    if (value != 0.0F) {
        return value;
    }
    return static_cast<float>(static_cast<double>(a.x) * static_cast<double>(b.y) -
                              static_cast<double>(a.y) * static_cast<double>(b.x));
}

}  // namespace

std::optional<TriangleHit> testTriangle(const RaySetup& ray, const BvhTriangle& triangle) {
    const vec3 v0 = permuted(triangle.v0, ray.axis);
    const vec3 v1 = permuted(triangle.v1, ray.axis);
    const vec3 v2 = permuted(triangle.v2, ray.axis);
    const vec3 a = v0 - ray.origin;
    const vec3 b = v1 - ray.origin;
    const vec3 c = v2 - ray.origin;

    // Shear the ray onto the z axis.
    const vec2 pa(a.x - ray.shear.x * a.z, a.y - ray.shear.y * a.z);
    const vec2 pb(b.x - ray.shear.x * b.z, b.y - ray.shear.y * b.z);
    const vec2 pc(c.x - ray.shear.x * c.z, c.y - ray.shear.y * c.z);

    const float u = edgeFunction(pc, pb);
    const float v = edgeFunction(pa, pc);
    const float w = edgeFunction(pb, pa);
    if ((u < 0.0F || v < 0.0F || w < 0.0F) && (u > 0.0F || v > 0.0F || w > 0.0F)) {
        return std::nullopt;
    }
    const float determinant = u + v + w;
    if (determinant == 0.0F) {
        return std::nullopt;
    }

    const float b0 = u / determinant;
    const float b1 = v / determinant;
    const float b2 = w / determinant;
    const float t = b0 * (a.z * ray.shear.z) + b1 * (b.z * ray.shear.z) + b2 * (c.z * ray.shear.z);

    // Keep the distance inside the triangle's box.
    const vec3 lower = glm::min(glm::min(v0, v1), v2);
    const vec3 upper = glm::max(glm::max(v0, v1), v2);
    float nearest = -kInfinity;
    float farthest = kInfinity;
    for (int i = 0; i < 3; ++i) {
        const bool negative = ray.negative[static_cast<std::size_t>(i)];
        nearest =
            std::max(nearest, ((negative ? upper[i] : lower[i]) - ray.origin_near[i]) * ray.reciprocal[i]);
        farthest =
            std::min(farthest, ((negative ? lower[i] : upper[i]) - ray.origin_far[i]) * ray.reciprocal[i]);
    }
    farthest = std::max(farthest * kBvhFarWider, farthest * kBvhFarNarrower);
    return TriangleHit{std::min(std::max(t, nearest), farthest), b1, b2};
}

std::optional<BvhHit> intersectTriangle(const Ray& ray, const BvhTriangle& triangle) {
    const std::optional<RaySetup> setup =
        isUsable(triangle) ? setUpRay(ray, boundsOf(triangle)) : std::nullopt;
    if (!setup) {
        return std::nullopt;
    }
    const std::optional<TriangleHit> hit = testTriangle(*setup, triangle);
    if (!hit || !(hit->t >= ray.t_min && hit->t < ray.t_max)) {
        return std::nullopt;
    }
    return BvhHit{0, hit->t, hit->b1, hit->b2};
}

}  // namespace licht
