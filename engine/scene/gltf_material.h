#pragma once
// Materials and the texture slots they read.
#include <cstdint>
#include <map>
#include <string>

#include "licht/scene/gltf_asset.h"
#include "licht/scene/gltf_image.h"
#include "licht/scene/scene.h"

namespace licht::gltf {

/// Turns materials into materials of the scene, each one once and only when a primitive asks for it.
class MaterialLoader {
public:
    MaterialLoader(Asset& asset, Scene& scene) : asset_(asset), scene_(scene), textures_(asset, scene) {}

    /// Index into Scene::materials; -1 is glTF's default material.
    std::uint32_t load(int material, const std::string& object);

    /// Once all are loaded: decodes the textures. Where one cannot be read, slots of colours show its
    /// stand-in and the others go without.
    void finish();

private:
    Material convert(const tinygltf::Material& source, const std::string& object);
    void readExtensions(const tinygltf::Material& source, const std::string& object, Material& material);
    TextureSlot slot(int texture, int uv_set, const tinygltf::ExtensionMap& extensions,
                     const std::string& object);
    TextureSlot slot(const tinygltf::Value& extension, const std::string& name, const std::string& object);
    float clamped(double value, double lower, double upper, const std::string& object, std::string_view what);

    Asset& asset_;
    Scene& scene_;
    TextureLoader textures_;
    std::map<int, std::uint32_t> loaded_;
};

}  // namespace licht::gltf
