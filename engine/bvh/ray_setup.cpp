#include "licht/bvh/ray_setup.h"

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
    setup.axis = {(kz + 1) % 3, (kz + 2) % 3, kz};
    setup.origin = permuted(ray.origin, setup.axis);
    const vec3 direction = permuted(ray.direction, setup.axis);
    setup.shear = {direction.x / direction.z, direction.y / direction.z, 1.0F / direction.z};

    const vec3 reach = glm::max(glm::abs(permuted(scene.lower, setup.axis) - setup.origin),
                                glm::abs(permuted(scene.upper, setup.axis) - setup.origin));
    const float shortest = std::abs(direction.z) * kBvhFlattestDirection;
    for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        setup.negative[k] = direction[i] < 0.0F;
        const float sign = setup.negative[k] ? -1.0F : 1.0F;
        setup.reciprocal[i] = 1.0F / (sign * std::max(std::abs(direction[i]), shortest));
        const float slack =
            i == 2 ? 0.0F
                   : (reach[i] + reach.z) * kBvhShearSlack + std::abs(setup.origin[i]) * kBvhOriginSlack;
        setup.origin_near[i] = setup.origin[i] + sign * slack;
        setup.origin_far[i] = setup.origin[i] - sign * slack;
    }
    return setup;
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
