#include "licht/scene/gltf_material.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "licht/scene/material_numbers.h"
#include "licht/scene/slot_table.h"

namespace licht::gltf {
namespace {

constexpr auto kMost = static_cast<double>(kUnlimited);

/// key: "x.y" is the member y of the object x.
double number(const tinygltf::Value& object, const std::string& key, double fallback) {
    if (const std::size_t dot = key.find('.'); dot != std::string::npos) {
        const std::string outer = key.substr(0, dot);
        return object.Has(outer) ? number(object.Get(outer), key.substr(dot + 1), fallback) : fallback;
    }
    return object.Has(key) && object.Get(key).IsNumber() ? object.Get(key).GetNumberAsDouble() : fallback;
}

template <std::size_t kSize>
std::array<double, kSize> numbers(const tinygltf::Value& object, const std::string& key, double fallback) {
    std::array<double, kSize> result{};
    result.fill(fallback);
    if (object.Has(key)) {
        const auto& list = object.Get(key).Get<tinygltf::Value::Array>();
        for (std::size_t i = 0; i < std::min(kSize, list.size()); ++i) {
            result.at(i) = list[i].IsNumber() ? list[i].GetNumberAsDouble() : fallback;
        }
    }
    return result;
}

const tinygltf::Value* find(const tinygltf::ExtensionMap& extensions, const std::string& name) {
    const auto it = extensions.find(name);
    return it != extensions.end() && it->second.IsObject() ? &it->second : nullptr;
}

Wrap wrapOf(int mode) {
    switch (mode) {
        case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
            return Wrap::clamp;
        case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
            return Wrap::mirror;
        default:
            return Wrap::repeat;
    }
}

}  // namespace

std::uint32_t MaterialLoader::load(int material, const std::string& object) {
    if (const auto it = loaded_.find(material); it != loaded_.end()) {
        return it->second;
    }
    Material converted;
    if (material == -1) {
        converted.name = "default";
    } else {
        const tinygltf::Material& source = at(asset_, asset_.model.materials, material, object, "material");
        const std::string name = objectName("material", static_cast<std::size_t>(material), source.name);
        converted = convert(source, name);
        converted.name = source.name.empty() ? name : oneLine(source.name);
    }
    const auto index = static_cast<std::uint32_t>(scene_.materials.size());
    scene_.materials.push_back(std::move(converted));
    loaded_.emplace(material, index);
    return index;
}

void MaterialLoader::finish() {
    const std::vector<bool> broken = textures_.decodeAll();
    for (Material& material : scene_.materials)
        for (const SlotInfo& info : kSlotTable) {
            TextureSlot& slot = material.slots[info.kind];
            if (!slot.present() || !broken[slot.texture]) continue;
            slot.linear = false;  // checks with edges
            if (!info.srgb) slot = {};
        }
}

float MaterialLoader::clamped(double value, double lower, double upper, const std::string& object,
                              std::string_view what) {
    if (value >= lower && value <= upper) {
        return static_cast<float>(value);
    }
    const double inside = std::isnan(value) ? lower : std::clamp(value, lower, upper);
    asset_.warn(
        fmt::format("{}: {} {} is outside of its range and taken as {}", object, what, value, inside));
    return static_cast<float>(inside);
}

Material MaterialLoader::convert(const tinygltf::Material& source, const std::string& object) {
    Material material;
    const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
    for (int i = 0; i < 4; ++i) {
        material.base_color[i] =
            clamped(pbr.baseColorFactor.at(static_cast<std::size_t>(i)), 0, 1, object, "baseColorFactor");
    }
    for (int i = 0; i < 3; ++i) {
        material.emission[i] = clamped(source.emissiveFactor.at(static_cast<std::size_t>(i)), 0, kMost,
                                       object, "emissiveFactor");
    }
    material.metallic = clamped(pbr.metallicFactor, 0, 1, object, "metallicFactor");
    material.roughness = clamped(pbr.roughnessFactor, 0, 1, object, "roughnessFactor");
    material.normal_scale = clamped(source.normalTexture.scale, -kMost, kMost, object, "normalTexture.scale");
    material.alpha_cutoff = clamped(source.alphaCutoff, 0, kMost, object, "alphaCutoff");
    material.double_sided = source.doubleSided;
    if (source.alphaMode == "MASK") {
        material.alpha_mode = AlphaMode::mask;
    } else if (source.alphaMode == "BLEND") {
        material.alpha_mode = AlphaMode::blend;
    } else if (source.alphaMode != "OPAQUE") {
        asset_.warn(fmt::format("{}: alpha mode '{}' is unknown and taken as OPAQUE", object,
                                oneLine(source.alphaMode)));
    }
    const auto textured = [&](const auto& info) {
        return slot(info.index, info.texCoord, info.extensions, object);
    };
    material.slots[kSlotBaseColor] = textured(pbr.baseColorTexture);
    material.slots[kSlotMetallicRoughness] = textured(pbr.metallicRoughnessTexture);
    material.slots[kSlotNormal] = textured(source.normalTexture);
    material.slots[kSlotEmissive] = textured(source.emissiveTexture);
    for (const SlotInfo& info : kSlotTable) {
        if (const auto* extension = find(source.extensions, std::string(info.extension))) {
            material.slots[info.kind] = slot(*extension, std::string(info.key), object);
        }
    }
    readExtensions(source, object, material);
    return material;
}

void MaterialLoader::readExtensions(const tinygltf::Material& source, const std::string& object,
                                    Material& material) {
    for (const MaterialNumber& row : kMaterialNumbers) {
        if (const auto* extension = find(source.extensions, std::string(row.extension))) {
            float& value = row.of(material);
            value = clamped(number(*extension, std::string(row.key), static_cast<double>(value)),
                            static_cast<double>(row.least), static_cast<double>(row.most), object, row.key);
        }
    }
    material.unlit = find(source.extensions, "KHR_materials_unlit") != nullptr;
    if (const auto* strength = find(source.extensions, "KHR_materials_emissive_strength")) {
        material.emission *=
            clamped(number(*strength, "emissiveStrength", 1.0), 0, kMost, object, "emissiveStrength");
        material.emission = glm::min(material.emission, vec3(std::numeric_limits<float>::max()));
    }
    if (const auto* ior = find(source.extensions, "KHR_materials_ior")) {
        const double value = number(*ior, "ior", 1.5);
        material.ior = value == 0.0 ? 0.0F : clamped(value, 1, kMost, object, "ior");
    }
    if (const auto* specular = find(source.extensions, "KHR_materials_specular")) {
        const auto color = numbers<3>(*specular, "specularColorFactor", 1.0);
        for (int i = 0; i < 3; ++i) {
            material.specular_color[i] =
                clamped(color.at(static_cast<std::size_t>(i)), 0, kMost, object, "specularColorFactor");
        }
    }
}

TextureSlot MaterialLoader::slot(const tinygltf::Value& extension, const std::string& name,
                                 const std::string& object) {
    if (!extension.Has(name) || !extension.Get(name).IsObject()) {
        return {};
    }
    const tinygltf::Value& info = extension.Get(name);
    tinygltf::ExtensionMap extensions;
    if (info.Has("extensions") && info.Get("extensions").IsObject()) {
        extensions = info.Get("extensions").Get<tinygltf::Value::Object>();
    }
    const auto integer = [&info](const char* key, int fallback) {
        return info.Has(key) && info.Get(key).IsInt() ? info.Get(key).GetNumberAsInt() : fallback;
    };
    return slot(integer("index", -1), integer("texCoord", 0), extensions, object);
}

TextureSlot MaterialLoader::slot(int texture, int uv_set, const tinygltf::ExtensionMap& extensions,
                                 const std::string& object) {
    TextureSlot result;
    if (texture == -1) {
        return result;
    }
    const tinygltf::Texture& source = at(asset_, asset_.model.textures, texture, object, "texture");
    if (source.source == -1) {
        asset_.warn(fmt::format("{}: texture {} has no image in a format that is supported; it is left out",
                                object, texture));
        return result;
    }
    if (const auto* transform = find(extensions, "KHR_texture_transform")) {
        // The extension's document: translation * rotation * scale. Its rotation is counter-clockwise as the
        // picture is seen, with v downward.
        const auto offset = numbers<2>(*transform, "offset", 0.0);
        const auto scale = numbers<2>(*transform, "scale", 1.0);
        const double angle = number(*transform, "rotation", 0.0);
        const double c = std::cos(angle);
        const double s = std::sin(angle);
        result.u_from_uv = vec3(glm::dvec3(c * scale[0], s * scale[1], offset[0]));
        result.v_from_uv = vec3(glm::dvec3(-s * scale[0], c * scale[1], offset[1]));
        uv_set = static_cast<int>(std::clamp(number(*transform, "texCoord", uv_set), -1.0, 1.0 * kMaxUvSets));
        if (!isPlace(result.u_from_uv) || !isPlace(result.v_from_uv)) {
            asset_.warn(fmt::format("{}: a texture transform is too large and left out", object));
            result = TextureSlot{};
        }
    }
    if (uv_set < 0 || uv_set >= kMaxUvSets) {
        asset_.warn(fmt::format("{}: texture coordinate set {} is not supported; its texture is left out",
                                object, uv_set));
        return result;
    }
    result.uv_set = static_cast<std::uint32_t>(uv_set);
    if (source.sampler != -1) {
        const tinygltf::Sampler& sampler =
            at(asset_, asset_.model.samplers, source.sampler, object, "sampler");
        result.wrap_u = wrapOf(sampler.wrapS);
        result.wrap_v = wrapOf(sampler.wrapT);
        result.linear = sampler.magFilter != TINYGLTF_TEXTURE_FILTER_NEAREST;
    }
    result.texture = textures_.load(source.source, object);
    return result;
}

}  // namespace licht::gltf
