#pragma once
// EXT_mesh_gpu_instancing: one node that places its mesh many times.
#include <optional>
#include <vector>

#include "licht/core/math.h"
#include "licht/scene/gltf_asset.h"

namespace licht::gltf {

/// Transforms of the node's instances relative to the node; nullopt where the node has no such extension.
/// Throws InputError naming the node: an attribute of another type, accessors of different lengths, no
/// attributes.
std::optional<std::vector<glm::dmat4>> readInstances(Asset& asset, int node);

/// Indices of the accessors that readInstances() would read, as they stand there, unchecked; nullopt as
/// there.
std::optional<std::vector<int>> instanceAccessors(const Asset& asset, int node);

}  // namespace licht::gltf
