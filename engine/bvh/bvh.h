#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "licht/core/math.h"
#include "licht/shared/bvh_layout.h"

namespace licht {

/// Three vertices in world space.
struct BvhTriangle {
    vec3 v0, v1, v2;
};

/// A wide bounding volume hierarchy over triangles, in the layout that the shaders read
/// (licht/shared/bvh_layout.h).
struct Bvh {
    std::vector<BvhNode>
        nodes;  ///< nodes[0] is the root; never empty: an empty scene has one node without children
    std::vector<std::uint32_t>
        triangle_ids;  ///< position in the leaves' order -> index of the input triangle
    std::uint32_t max_stack =
        0;  ///< entries a traversal can ever hold at once; traversals size their stack by it; at least 1
    std::uint32_t depth = 0;  ///< levels of nodes; 1 for the root alone
    std::uint32_t dropped =
        0;          ///< input triangles left out: a non-finite or > 1.8e18 coordinate, or exactly zero area
    Bounds bounds;  ///< of the kept triangles
    std::uint32_t input_triangles = 0;  ///< kept or dropped
    double sah_cost = 0.0;       ///< when it was built; see sahCost() (of the boxes before they were encoded)
    double triangle_area = 0.0;  ///< when it was built: area of the triangles' own boxes over the root's
    double build_seconds = 0.0;
};

/// What a tree may cost to build, and give back to every ray.
enum class BvhQuality {
    fast,      ///< along a space-filling curve (Lauterbach et al. 2009, Fast BVH Construction on GPUs)
    balanced,  ///< full binned SAH
    best       ///< balanced, then improved by reinsertion
};

struct BvhBuildOptions {
    BvhQuality quality = BvhQuality::balanced;
};

/// Builds by binned SAH (Wald 2007, On fast Construction of SAH-based Bounding Volume Hierarchies), binary,
/// or as BvhQuality says, then collapsed to wide nodes at the least SAH cost, on all threads that oneTBB has.
/// Each triangle is in one leaf. Identical centroids fall back to halving by index, so the depth is bounded
/// by 2 log2(n) + a constant and max_stack is exact. Deterministic: same input, same tree, whatever the
/// number of threads. Throws InputError for more than kBvhMostTriangles triangles.
Bvh buildBvh(std::span<const BvhTriangle> triangles, const BvhBuildOptions& options = {});

struct BvhHit {
    std::uint32_t triangle = 0;  ///< index of the input triangle
    float t = 0.0F;
    float b1 = 0.0F;  ///< barycentric weight of v1
    float b2 = 0.0F;  ///< barycentric weight of v2
};

/// Watertight ray-triangle test (Woop, Benthin, Wald 2013, Watertight Ray/Triangle Intersection). nullopt
/// outside [t_min, t_max).
std::optional<BvhHit> intersectTriangle(const Ray& ray, const BvhTriangle& triangle);

/// CPU reference traversal: the nearest hit; ties go to the lower triangle index. Bit for bit what
/// intersectBruteForce() returns. A ray that is not finite, starts beyond kBvhLargestCoordinate or is shorter
/// than kBvhShortestDirection hits nothing (licht/shared/bvh_numerics.h).
std::optional<BvhHit> intersect(const Bvh& bvh, std::span<const BvhTriangle> triangles, const Ray& ray);

/// What one traversal cost.
struct TraversalSteps {
    std::uint32_t nodes = 0;
    std::uint32_t triangles = 0;
    std::uint32_t stack = 0;  ///< the most entries that waited at once
};
/// any_hit: the first hit that is found ends the walk, as for the device's shadow rays.
std::optional<BvhHit> intersect(const Bvh& bvh, std::span<const BvhTriangle> triangles, const Ray& ray,
                                TraversalSteps* steps, bool any_hit = false);

/// The naive reference: every triangle, one after the other.
std::optional<BvhHit> intersectBruteForce(std::span<const BvhTriangle> triangles, const Ray& ray);

}  // namespace licht
