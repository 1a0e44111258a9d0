#pragma once
// What a node carries besides meshes: cameras and lights.
#include "licht/scene/gltf_asset.h"
#include "licht/scene/scene.h"

namespace licht::gltf {

/// The node's camera in the world; nullopt, with a note, where its parameters or its transform give none.
std::optional<Camera> readCamera(Asset& asset, int node, const glm::dmat4& world_from_node);

/// The node's light (KHR_lights_punctual) in the world; nullopt where it has none, or with a note where it is
/// of no use.
std::optional<PunctualLight> readLight(Asset& asset, int node, const glm::dmat4& world_from_node);

}  // namespace licht::gltf
