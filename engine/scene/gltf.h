#pragma once
#include <filesystem>
#include <optional>

#include "licht/scene/scene.h"

namespace licht {

/// Loads a .gltf or .glb with the extensions of gltf_extensions.h. `scene_index` picks one of several scenes;
/// without it the file's default, or the first. Throws InputError of one line: file, object in it, reason.
/// What is skipped or changed is in Scene::notes. Files are read only from the folder of `path` and below it.
Scene loadGltf(const std::filesystem::path& path, std::optional<std::uint32_t> scene_index = std::nullopt);

}  // namespace licht
