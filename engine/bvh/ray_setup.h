#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include "licht/bvh/bvh.h"

namespace licht {

/// What a ray needs once before it meets boxes and triangles. Permuted vectors: .z is the axis along which
/// the ray goes furthest. The direction is scaled by a power of two; distances in here are those of the ray
/// times distance_scale. Boxes are widened by what shearing a vertex of the scene can round, so that a ray
/// meets the box of every triangle whose edges accept it.
struct RaySetup {
    std::array<int, 3> axis{};  ///< world axis of each permuted one
    vec3 origin{};              ///< permuted
    vec3 shear{};               ///< permuted; x, y: slope against z; z: 1 / direction.z
    vec2 reciprocal{};          ///< permuted; 1 / direction, finite; of z it is shear.z
    vec2 slack{};  ///< permuted; how much earlier and later than its planes a box is met, as a distance
    float distance_scale = 1.0F;
    float t_min = 0.0F;  ///< scaled
    float t_max = 0.0F;
};

inline vec3 permuted(const vec3& v, const std::array<int, 3>& axis) {
    return {v[axis[0]], v[axis[1]], v[axis[2]]};
}

/// scene: gridBounds() of all triangles. nullopt: this ray hits nothing (not finite, no direction, too far
/// out, or an empty range).
std::optional<RaySetup> setUpRay(const Ray& ray, const Bounds& scene);

struct TriangleHit {
    float t = 0.0F;  ///< scaled
    float b1 = 0.0F;
    float b2 = 0.0F;
};

/// The distance is kept inside the triangle's own box as the traversal measures it; so a traversal that skips
/// boxes beyond the nearest hit returns exactly what testing every triangle returns. No range is applied
/// here.
std::optional<TriangleHit> testTriangle(const RaySetup& ray, const BvhTriangle& triangle);

/// Keeps the nearest hit in the ray's range; ties go to the lower triangle index.
class NearestHit {
public:
    explicit NearestHit(const RaySetup& ray) : ray_(ray), t_(ray.t_max) {}
    /// A triangle that is met at t counts if t is below this; at it, by the tie rule.
    [[nodiscard]] float reach() const { return t_; }
    void offer(std::uint32_t triangle, const TriangleHit& hit);
    [[nodiscard]] std::optional<BvhHit> result() const { return best_; }

private:
    const RaySetup& ray_;
    float t_;
    std::optional<BvhHit> best_;
};

/// Finite, inside kBvhLargestCoordinate, and not exactly flat.
bool isUsable(const BvhTriangle& triangle);
Bounds boundsOf(const BvhTriangle& triangle);

}  // namespace licht
