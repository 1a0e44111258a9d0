#pragma once
// Whether two ray tracers mean the same hit.
#include <span>
#include <vector>

#include "licht/bvh/bvh.h"
#include "licht/shared/ray_records.h"

namespace licht {

/// How far two fp32 intersections of this ray with this triangle may lie apart, in units of t. Infinite where
/// the ray runs in the triangle's plane.
double distanceBound(const RayRecord& ray, const BvhTriangle& triangle, float t);

/// Places in the list where one hits and the other does not, or, unless any_hit, both hit further apart than
/// the distance bounds of their triangles.
std::vector<std::size_t> differences(std::span<const BvhTriangle> triangles, std::span<const RayRecord> rays,
                                     bool any_hit, std::span<const RayHitRecord> a,
                                     std::span<const RayHitRecord> b);

}  // namespace licht
