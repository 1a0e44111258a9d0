#include "licht/bvh/ray_setup.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "licht/shared/bvh_numerics.h"

namespace licht {
namespace {

bool insideRange(const vec3& point) {
    return std::abs(point.x) <= kBvhLargestCoordinate && std::abs(point.y) <= kBvhLargestCoordinate &&
           std::abs(point.z) <= kBvhLargestCoordinate;  // false for NaN
}

}  // namespace

std::optional<RaySetup> setUpRay(const Ray& ray, const Bounds& scene) {
    const vec3 length = glm::abs(ray.direction);
    const bool finite = std::isfinite(length.x) && std::isfinite(length.y) && std::isfinite(length.z);
    if (!finite || !insideRange(ray.origin) || !(ray.t_min < ray.t_max)) {
        return std::nullopt;
    }
    const int kz = length.x >= length.y && length.x >= length.z ? 0 : (length.y >= length.z ? 1 : 2);
    if (length[kz] < kBvhShortestDirection) {
        return std::nullopt;
    }

    RaySetup setup;
    // The power of two at or below the longest component; one below the last, whose reciprocal would be
    // denormal.
    const std::uint32_t exponent = std::min(std::bit_cast<std::uint32_t>(length[kz]) >> 23U, 253U);
    setup.distance_scale = std::bit_cast<float>(exponent << 23U);
    const float direction_scale = std::bit_cast<float>((254U - exponent) << 23U);
    setup.t_min = ray.t_min > 0.0F ? ray.t_min * setup.distance_scale : 0.0F;
    setup.t_max = ray.t_max * setup.distance_scale;

    setup.axis = {(kz + 1) % 3, (kz + 2) % 3, kz};
    setup.origin = permuted(ray.origin, setup.axis);
    const vec3 direction = permuted(ray.direction * direction_scale, setup.axis);
    setup.shear = {direction.x / direction.z, direction.y / direction.z, 1.0F / direction.z};

    const vec3 reach = glm::max(glm::abs(permuted(scene.lower, setup.axis) - setup.origin),
                                glm::abs(permuted(scene.upper, setup.axis) - setup.origin));
    const float shortest = std::abs(direction.z) * kBvhFlattestDirection;
    for (int i = 0; i < 2; ++i) {
        const float sign = direction[i] < 0.0F ? -1.0F : 1.0F;
        setup.reciprocal[i] = 1.0F / (sign * std::max(std::abs(direction[i]), shortest));
        const float slack =
            (reach[i] + reach.z) * kBvhShearSlack + std::abs(setup.origin[i]) * kBvhOriginSlack;
        setup.slack[i] = slack * std::abs(setup.reciprocal[i]);
    }
    return setup;
}

void NearestHit::offer(std::uint32_t triangle, const TriangleHit& hit) {
    if (!(hit.t >= ray_.t_min && hit.t < ray_.t_max)) return;
    const bool nearer = hit.t < t_ || (hit.t == t_ && best_ && triangle < best_->triangle);
    if (!nearer) return;
    t_ = hit.t;
    best_ = BvhHit{triangle, hit.t / ray_.distance_scale, hit.b1, hit.b2};
}

bool isUsable(const BvhTriangle& triangle) {
    if (!insideRange(triangle.v0) || !insideRange(triangle.v1) || !insideRange(triangle.v2)) {
        return false;
    }
    const glm::dvec3 edge1 = glm::dvec3(triangle.v1) - glm::dvec3(triangle.v0);
    const glm::dvec3 edge2 = glm::dvec3(triangle.v2) - glm::dvec3(triangle.v0);
    return glm::cross(edge1, edge2) != glm::dvec3(0.0);
}

Bounds boundsOf(const BvhTriangle& triangle) {
    Bounds bounds;
    bounds.extend(triangle.v0);
    bounds.extend(triangle.v1);
    bounds.extend(triangle.v2);
    return bounds;
}

}  // namespace licht
