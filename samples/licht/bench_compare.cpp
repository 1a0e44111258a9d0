#include "samples/licht/bench_compare.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "licht/shared/index.h"

namespace licht {

// Let u = 2^-24, L the longest edge, N the cross product of two edges, A = L^2 / |N|, c the cosine between
// ray and normal, d the direction's length. First-order bounds of |error of t| d c, each in units of u A (t d
// + L):
// - plane distance over Ng (Moeller and Trumbore 1997): the products of edges err by 5 (each edge 1, product
// 1, difference
//   1, over two terms), which tilts numerator and denominator alike: 2 * 5; their dot products by 3 each: 6;
// - sheared vertices (Woop, Benthin, Wald 2013): moved sideways by up to 10 (bvh_numerics.h: 2 |x| + 8 |z|);
//   each of three edge functions errs by 3 of L^2, and t follows by up to L: 9;
// - the divisions: 3 each.
// Together below 48; both tracers may have either kind, so twice that.
constexpr double kBoundUnits = 2.0 * 48.0;

double distanceBound(const RayRecord& ray, const BvhTriangle& triangle, float t) {
    using glm::dvec3;
    const dvec3 v0(triangle.v0);
    const dvec3 e1 = dvec3(triangle.v1) - v0;
    const dvec3 e2 = dvec3(triangle.v2) - v0;
    const dvec3 normal = glm::cross(e1, e2);
    const dvec3 direction(ray.direction);
    const double longest = std::max({glm::length(e1), glm::length(e2), glm::length(e2 - e1)});
    const double speed = glm::length(direction);
    const double facing = std::abs(glm::dot(normal, direction));  // |N| c d
    // u A (t d + L) / (c d) with A / (c d) = L^2 / (|N| c d)
    return kBoundUnits * 0x1p-24 * longest * longest * (std::abs(static_cast<double>(t)) * speed + longest) /
           facing;
}

std::vector<std::size_t> differences(std::span<const BvhTriangle> triangles, std::span<const RayRecord> rays,
                                     bool any_hit, std::span<const RayHitRecord> a,
                                     std::span<const RayHitRecord> b) {
    assert(a.size() == rays.size() && b.size() == rays.size());
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const bool hit_a = a[i].triangle != kNoIndex;
        const bool hit_b = b[i].triangle != kNoIndex;
        bool same = hit_a == hit_b && a[i].triangle != kRayTruncated;
        if (same && hit_a && !any_hit) {
            const double bound = std::max(distanceBound(rays[i], triangles[a[i].triangle], a[i].t),
                                          distanceBound(rays[i], triangles[b[i].triangle], b[i].t));
            same = std::abs(static_cast<double>(a[i].t) - static_cast<double>(b[i].t)) <= bound;
        }
        if (!same) places.push_back(i);
    }
    return places;
}

}  // namespace licht
