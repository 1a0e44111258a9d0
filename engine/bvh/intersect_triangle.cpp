// Woop, Benthin, Wald 2013, Watertight Ray/Triangle Intersection, without its culling, its swap of axes (both
// sides count) and its look at zeros in double precision (zeros count as inside): the twin of
// shaders/pure/intersect.glsl, which says why.
#include <algorithm>
#include <cmath>

#include "licht/bvh/ray_setup.h"
#include "licht/shared/bvh_numerics.h"

namespace licht {
namespace {

/// a x b. Rounding is monotonic, so a sign is right or the value is zero.
float edgeFunction(const vec2& a, const vec2& b) {
    return a.x * b.y - a.y * b.x;
}

float smallest(const vec3& v) {
    return std::min(std::min(v.x, v.y), v.z);
}

float largest(const vec3& v) {
    return std::max(std::max(v.x, v.y), v.z);
}

/// How far off the distance of a hit may be: kBvhDistanceSlack says why. z: distances to the vertices.
float distanceUncertainty(const vec2& a, const vec2& b, const vec2& c, float determinant, const vec3& z) {
    const float beside =
        std::max(largest(glm::abs(vec3(a.x, b.x, c.x))), largest(glm::abs(vec3(a.y, b.y, c.y))));
    const float away = beside + 2.0F * std::max(std::abs(smallest(z)), std::abs(largest(z)));
    return kBvhDistanceSlack * (beside / std::abs(determinant) * away) * (largest(z) - smallest(z));
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

    const vec3 x = vec3(a.x, b.x, c.x) * ray.reciprocal.x;
    const vec3 y = vec3(a.y, b.y, c.y) * ray.reciprocal.y;
    const vec3 z = vec3(a.z, b.z, c.z) * ray.shear.z;
    const float b1 = v / determinant;
    const float b2 = w / determinant;
    const float t = u / determinant * z.x + b1 * z.y + b2 * z.z;
    if (!(smallest(z) > 0.0F || t >= distanceUncertainty(pa, pb, pc, determinant, z))) {
        return std::nullopt;
    }

    // Keep the distance inside the triangle's box.
    const float nearest =
        std::max(std::max(smallest(x) - ray.slack.x, smallest(y) - ray.slack.y), smallest(z));
    const float farthest = std::min(std::min(largest(x) + ray.slack.x, largest(y) + ray.slack.y), largest(z));
    if (!(nearest <= farthest)) {
        return std::nullopt;
    }
    return TriangleHit{std::min(std::max(t, nearest), farthest), b1, b2};
}

std::optional<BvhHit> intersectTriangle(const Ray& ray, const BvhTriangle& triangle) {
    return intersectBruteForce(std::span(&triangle, 1), ray);
}

}  // namespace licht
