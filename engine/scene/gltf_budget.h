#pragma once
// What an asset describes, summed up before any of it is made: a file of a few hundred bytes can stand for
// more than a machine has.
#include "licht/scene/gltf_asset.h"
#include "licht/scene/gltf_nodes.h"

namespace licht::gltf {

/// Throws InputError naming the file, the largest object and the numbers, where what is visible
/// takes more memory than there may be, reads more elements from accessors without bytes of their own than
/// any file needs, or places more meshes than can be traced.
void requireBudget(const Asset& asset, const NodeTree& tree);

}  // namespace licht::gltf
