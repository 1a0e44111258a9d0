#pragma once
// The extensions of glTF that the loader knows. README.md repeats the list; a test compares them.
#include <algorithm>
#include <array>
#include <string_view>

namespace licht {

inline constexpr std::array kGltfExtensions = std::to_array<std::string_view>({
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "KHR_lights_punctual",
    "KHR_materials_clearcoat",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_specular",
    "KHR_materials_unlit",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
});

constexpr bool knowsGltfExtension(std::string_view name) {
    return std::find(kGltfExtensions.begin(), kGltfExtensions.end(), name) != kGltfExtensions.end();
}

}  // namespace licht
