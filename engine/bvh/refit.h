#pragma once
#include <cstdint>
#include <span>

#include "licht/bvh/bvh.h"

namespace licht {

/// What a refit found.
struct RefitResult {
    double sah_cost = 0.0;  ///< of the refitted boxes; see sahCost()
    double loss = 1.0;  ///< how many times more a ray is expected to cost than in the tree as it was built
    std::uint32_t missing = 0;  ///< usable triangles that the tree does not hold and no ray will hit
};

/// Fits the boxes to triangles that have moved: same number, same order, same topology. As exact as a new
/// tree as long as RefitResult::missing is 0. A triangle that has become unusable (see Bvh::dropped) counts
/// as dropped and is never hit until it is usable again. One that was dropped by the build is not in the
/// tree: when it becomes usable it is missing. On all threads. Throws InputError for another number of
/// triangles than the tree was built from.
RefitResult refitBvh(Bvh& bvh, std::span<const BvhTriangle> triangles);

/// A refitted tree that costs more than this many times what it did is worth a new one: a build takes as long
/// as five to ten refits.
inline constexpr double kMostRefitLoss = 1.5;

/// True when triangles are missing or the loss is larger than kMostRefitLoss. The loss is the larger one of
/// two factors. One is the growth of the SAH cost, relative to the root's box. The other is its growth
/// relative to the boxes of the triangles themselves, which sees what the first does not: a triangle that
/// flies away widens the root's box along with everything on the way to it. Both also count what no new tree
/// could undo (triangles that have grown long), so the loss is rather too large than too small.
bool wantsRebuild(const RefitResult& result);

}  // namespace licht
