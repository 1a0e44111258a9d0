#pragma once
#include <cstdint>
#include <span>

#include "licht/bvh/bvh.h"

namespace licht {

/// What the steps of a traversal cost, in any unit. The builder weighs nodes against triangles by them, so
/// they are best measured on the traversal that runs.
inline constexpr double kBvhNodeCost = 1.5;      ///< fetching a wide node and testing its children's boxes
inline constexpr double kBvhTriangleCost = 1.0;  ///< fetching and testing a triangle

/// The surface area heuristic: what a ray that hits the root's box is expected to spend on nodes and
/// triangles (kBvhNodeCost and kBvhTriangleCost for each), were rays spread evenly and nothing in their way.
/// Lower is better; comparable between trees over the same triangles. 0 for an empty tree.
double sahCost(const Bvh& bvh);

/// A sum of areas as a share of the root's; 0 for a root without area.
inline double relativeTo(double root_area, double area) {
    return root_area > 0.0 ? area / root_area : 0.0;
}

}  // namespace licht
