#pragma once
// Coordinates far from the world's origin have few digits behind the point; what nodes say in double
// precision is moved to where floats are dense before it becomes floats.
#include "licht/scene/gltf_asset.h"
#include "licht/scene/gltf_nodes.h"

namespace licht::gltf {

/// Moves all nodes so that what is visible lies around the origin, where it is far from it for its size (by
/// the bounds that accessors state: glTF 2.0, 3.6.2.5). Returns the point that became the origin: zero where
/// nothing was moved. Whole steps of a power of two, so that moving rounds nothing away that was there.
glm::dvec3 moveToOrigin(const Asset& asset, NodeTree& tree);

}  // namespace licht::gltf
