#pragma once
#include <span>

#include "licht/bvh/binary_tree.h"

namespace licht {

/// Lowers the SAH cost of a binary tree by moving subtrees to better places (Meister, Bittner 2018, Parallel
/// Reinsertion for Bounding Volume Hierarchy Optimization). Deterministic; the tree stays within
/// binaryDepthLimit().
void reinsert(std::span<BinaryNode> nodes);

}  // namespace licht
