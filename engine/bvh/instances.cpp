#include "licht/bvh/instances.h"

#include <algorithm>
#include <cmath>

#include "licht/shared/bvh_numerics.h"

namespace licht {
namespace {

/// Largest row sum of magnitudes: how much a matrix lengthens vectors in the maximum norm.
double rowSumNorm(const glm::dmat3& m) {
    const glm::dvec3 sums = glm::abs(m[0]) + glm::abs(m[1]) + glm::abs(m[2]);
    return std::max({sums.x, sums.y, sums.z});
}

}  // namespace

std::optional<BvhInstance> makeBvhInstance(std::uint32_t mesh, const mat4& world_from_object,
                                           const vec3& centre) {
    const glm::dmat3 linear(world_from_object);
    const glm::dvec3 pivot = linear * glm::dvec3(centre) + glm::dvec3(world_from_object[3]);
    const double determinant = glm::determinant(linear);
    if (determinant == 0.0) {
        return std::nullopt;
    }
    const glm::dmat3 inverse = glm::inverse(linear);
    const double norm = rowSumNorm(linear);
    const double inverse_norm = rowSumNorm(inverse);
    // The comparisons are false for NaN.
    const bool safe = norm * inverse_norm <= static_cast<double>(kMostCondition) &&
                      norm <= static_cast<double>(kMostInstanceScale) &&
                      inverse_norm <= static_cast<double>(kMostInstanceScale) &&
                      std::max({std::abs(pivot.x), std::abs(pivot.y), std::abs(pivot.z)}) *
                              static_cast<double>(kMostInstanceScale) <=
                          static_cast<double>(kBvhLargestCoordinate);
    if (!safe) {
        return std::nullopt;
    }
    return BvhInstance{mesh,
                       mat3(linear),
                       mat3(inverse),
                       vec3(pivot),
                       static_cast<float>(norm * inverse_norm),
                       determinant < 0.0};
}

vec3 worldFromObject(const BvhInstance& instance, const vec3& point) {
    return instance.world_from_object * point + instance.pivot;
}

Ray objectRay(const BvhInstance& instance, const Ray& ray) {
    return {instance.object_from_world * (ray.origin - instance.pivot),
            instance.object_from_world * ray.direction, ray.t_min, ray.t_max};
}

Bounds instanceBounds(const BvhInstance& instance, std::span<const vec3> points) {
    Bounds bounds;
    bounds.extend(instance.pivot);
    vec3 farthest(0.0F);
    for (const vec3& point : points) {
        bounds.extend(worldFromObject(instance, point));
        farthest = glm::max(farthest, glm::abs(point));
    }
    // Three products and three sums: at most 4 u of the magnitudes that are added (u = 2^-24), and the
    // margin's own rounding within a factor of two.
    const mat3& m = instance.world_from_object;
    const vec3 magnitudes = mat3(glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2])) * farthest;
    const vec3 margin = 0x1p-21F * (magnitudes + glm::abs(instance.pivot));
    return {bounds.lower - margin, bounds.upper + margin};
}

}  // namespace licht
