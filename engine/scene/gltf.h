#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>

#include "licht/scene/scene.h"

namespace licht {

struct GltfOptions {
    std::optional<std::uint32_t> scene{};  ///< which of several; none: the file's default, or the first
    bool strict =
        false;  ///< an image that cannot be read is an error; else a stand-in takes its place, noted
};

/// Loads a .gltf or .glb with the extensions of gltf_extensions.h. Throws InputError of one line: file,
/// object in it, reason; also where what the file describes exceeds memoryLimit(). What is skipped or changed
/// is in Scene::notes. Files are read only from the folder of `path` and below it.
Scene loadGltf(const std::filesystem::path& path, const GltfOptions& options = {});

}  // namespace licht
