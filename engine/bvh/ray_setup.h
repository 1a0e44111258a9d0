#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include "licht/bvh/bvh.h"

namespace licht {

/// What a ray needs once before it meets boxes and triangles. Vectors are permuted: .z is the axis along
/// which the ray goes furthest. Boxes are widened by what shearing a vertex of the scene can round, so that a
/// ray meets the box of every triangle whose edges accept it.
struct RaySetup {
    std::array<int, 3> axis{};  ///< world axis of each permuted one
    std::array<bool, 3>
        negative{};  ///< the ray goes down this permuted axis: its near plane is the upper one
    vec3 origin{};
    vec3 shear{};        ///< x, y: slope against z; z: 1 / direction.z
    vec3 reciprocal{};   ///< 1 / direction, finite
    vec3 origin_near{};  ///< origins that near and far planes are measured from
    vec3 origin_far{};
};

inline vec3 permuted(const vec3& v, const std::array<int, 3>& axis) {
    return {v[axis[0]], v[axis[1]], v[axis[2]]};
}

/// nullopt: this ray hits nothing (not finite, no direction, too far out, or an empty range).
std::optional<RaySetup> setUpRay(const Ray& ray, const Bounds& scene);

struct TriangleHit {
    float t = 0.0F;
    float b1 = 0.0F;
    float b2 = 0.0F;
};

/// The distance is kept inside the triangle's own box as the traversal measures it; so a traversal that skips
/// boxes beyond the nearest hit returns exactly what testing every triangle returns. No range is applied
/// here.
std::optional<TriangleHit> testTriangle(const RaySetup& ray, const BvhTriangle& triangle);

/// Finite, inside kBvhLargestCoordinate, and not exactly flat.
bool isUsable(const BvhTriangle& triangle);
Bounds boundsOf(const BvhTriangle& triangle);

}  // namespace licht
