#pragma once
// The pictures behind texture slots.
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "licht/image/files.h"
#include "licht/scene/gltf_asset.h"
#include "licht/scene/scene.h"

namespace licht::gltf {

/// Turns images into textures of the scene, each one once, whatever it is called, and only when a material
/// asks for it. First all headers are read, so that what all of them take is known before any is decoded.
class TextureLoader {
public:
    TextureLoader(Asset& asset, Scene& scene) : asset_(asset), scene_(scene) {}

    /// Index into what Scene::textures will be. An image that is missing or damaged is noted, or, where
    /// Asset::strict says so, an InputError that names it.
    std::uint32_t load(int image, const std::string& object);

    /// Fills Scene::textures. Per texture: whether its image cannot be read, for which a stand-in was taken,
    /// with a warning. Throws InputError where memory will not do.
    std::vector<bool> decodeAll();

private:
    struct Pending {
        std::string name;
        std::string object;  ///< for messages
        std::vector<std::byte> file;
        std::span<const std::byte> encoded;  ///< of the file or of a buffer view
        ImageShape shape;
        std::string fault;
    };
    std::optional<std::uint32_t> sameContent(const Pending& image);

    Asset& asset_;
    Scene& scene_;
    std::vector<Pending> pending_;  ///< by texture
    std::map<std::pair<std::string, int>, std::uint32_t> by_source_;
    std::unordered_map<std::size_t, std::vector<std::uint32_t>> by_hash_;
};

}  // namespace licht::gltf
