#pragma once
// The node hierarchy, flattened: nothing here recurses, so its depth is limited by memory alone.
#include <cstdint>
#include <vector>

#include "licht/core/math.h"
#include "licht/scene/gltf_asset.h"

namespace licht::gltf {

/// World transforms of all nodes, and those that belong to the chosen scene, parents before children.
struct NodeTree {
    std::vector<glm::dmat4> world_from_node;
    std::vector<int> visible;
};

/// Throws InputError naming the node: a child that is not there, two parents, a cycle, a transform of the
/// wrong length; or a scene that is not there. Without any scene every node is visible.
NodeTree flattenNodes(Asset& asset, std::optional<std::uint32_t> scene_index);

}  // namespace licht::gltf
