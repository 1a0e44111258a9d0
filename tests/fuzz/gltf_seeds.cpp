#include "gltf_seeds.h"

#include <stb_image_write.h>

#include <array>
#include <cstdint>

#include "licht/core/error.h"
#include "licht/core/memory.h"
#include "licht/scene/gltf.h"

namespace licht::fuzz {
namespace {

using test::GltfFile;
using test::Json;

constexpr std::array<std::uint8_t, 16> kTexels{200, 100, 50, 255, 0,   255, 0,   128,
                                               9,   8,   7,  0,   255, 255, 255, 255};

void append(void* bytes, void* data, int size) {
    static_cast<std::string*>(bytes)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

std::string text(const std::string& bytes, const char* type) {
    return std::string("data:") + type + ";base64," + test::base64(bytes);
}

/// A quad with all attributes, two UV sets, a texture in every slot.
GltfFile material() {
    GltfFile file;
    const int positions = file.vec3s({-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0});
    const int normals = file.vec3s({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    const int tangents = file.vec4s({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1});
    const int uvs = file.vec2s({0, 1, 1, 1, 1, 0, 0, 0});
    const int colors = file.accessor<std::uint8_t>(
        {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 9, 9, 9, 9}, test::kUnsignedByte, "VEC4", 4, true);
    file.mesh({{"attributes",
                {{"POSITION", positions},
                 {"NORMAL", normals},
                 {"TANGENT", tangents},
                 {"TEXCOORD_0", uvs},
                 {"TEXCOORD_1", uvs},
                 {"COLOR_0", colors}}},
               {"indices", file.indices({0, 1, 2, 0, 2, 3})},
               {"material", 0}});
    file.add("images", {{"bufferView", file.view(smallPng())}, {"mimeType", "image/png"}});
    file.add("images", {{"uri", text(smallJpeg(), "image/jpeg")}});
    file.add("samplers", {{"magFilter", 9728}, {"wrapS", 33071}, {"wrapT", 33648}});
    file.add("textures", {{"source", 0}, {"sampler", 0}});
    file.add("textures", {{"source", 1}});
    const Json moved{
        {"index", 0},
        {"texCoord", 1},
        {"extensions",
         {{"KHR_texture_transform", {{"offset", {0.5, 0.25}}, {"rotation", 0.5}, {"scale", {2, 3}}}}}}};
    const Json plain{{"index", 1}};
    file.add("materials", {{"name", "M"},
                           {"alphaMode", "MASK"},
                           {"alphaCutoff", 0.25},
                           {"doubleSided", true},
                           {"emissiveFactor", {1, 0.5, 0}},
                           {"emissiveTexture", plain},
                           {"normalTexture", {{"index", 0}, {"scale", 0.5}}},
                           {"pbrMetallicRoughness",
                            {{"baseColorFactor", {1, 1, 1, 0.5}},
                             {"baseColorTexture", moved},
                             {"metallicFactor", 0.5},
                             {"roughnessFactor", 0.25},
                             {"metallicRoughnessTexture", plain}}},
                           {"extensions",
                            {{"KHR_materials_emissive_strength", {{"emissiveStrength", 5}}},
                             {"KHR_materials_ior", {{"ior", 1.4}}},
                             {"KHR_materials_specular",
                              {{"specularFactor", 0.5},
                               {"specularTexture", plain},
                               {"specularColorFactor", {1, 2, 3}},
                               {"specularColorTexture", moved}}},
                             {"KHR_materials_clearcoat",
                              {{"clearcoatFactor", 0.5},
                               {"clearcoatTexture", plain},
                               {"clearcoatRoughnessFactor", 0.1},
                               {"clearcoatNormalTexture", plain}}},
                             {"KHR_materials_iridescence",
                              {{"iridescenceFactor", 1},
                               {"iridescenceIor", 1.3},
                               {"iridescenceThicknessMaximum", 400},
                               {"iridescenceThicknessTexture", plain}}}}}});
    file.root({{"mesh", 0}, {"rotation", {0, 0, 0, 1}}, {"scale", {1, 2, 3}}, {"translation", {4, 5, 6}}});
    file.json["extensionsUsed"] = {"KHR_texture_transform", "KHR_materials_ior"};
    return file;
}

/// Skin, morph targets, a sparse accessor, a strip, cameras, lights and instances.
GltfFile moving() {
    GltfFile file;
    const int positions = file.vec3s({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
    const int joints = file.accessor<std::uint8_t>({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0},
                                                   test::kUnsignedByte, "VEC4", 4);
    const int weights = file.vec4s({0.5, 0.5, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0.25, 0.75, 0, 0});
    const int sparse_at = file.view(test::bytesOf<std::uint16_t>(std::array<std::uint16_t, 2>{1, 3}));
    const int sparse_to = file.view(test::bytesOf<float>(std::array<float, 6>{0, 0, 1, 0, 0, 2}));
    const int deltas = file.add(
        "accessors", {{"componentType", test::kFloat},
                      {"type", "VEC3"},
                      {"count", 4},
                      {"sparse",
                       {{"count", 2},
                        {"indices", {{"bufferView", sparse_at}, {"componentType", test::kUnsignedShort}}},
                        {"values", {{"bufferView", sparse_to}}}}}});
    const int mesh =
        file.mesh({{"attributes", {{"POSITION", positions}, {"JOINTS_0", joints}, {"WEIGHTS_0", weights}}},
                   {"mode", 5},
                   {"targets", Json::array({{{"POSITION", deltas}}})}});
    file.json["meshes"][0]["weights"] = {0.5};
    const int bind = file.accessor<float>(
        {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 1},
        test::kFloat, "MAT4", 2);
    const int first = file.root({{"name", "joint"}});
    const int second = file.root({{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 2, 1}}});
    file.add("skins", {{"joints", {first, second}}, {"inverseBindMatrices", bind}});
    file.root({{"mesh", mesh}, {"skin", 0}});
    file.add("cameras",
             {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}, {"zfar", 100}}}});
    file.add("cameras", {{"type", "orthographic"},
                         {"orthographic", {{"xmag", 1}, {"ymag", 2}, {"znear", 0}, {"zfar", 9}}}});
    file.root({{"camera", 0}, {"translation", {0, 0, 5}}});
    file.root({{"camera", 1}});
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"},
         {"intensity", 5},
         {"range", 10},
         {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.5}}}},
        {{"type", "directional"}, {"color", {1, 0.5, 0}}},
        {{"type", "point"}}};
    for (int light = 0; light < 3; ++light)
        file.root({{"extensions", {{"KHR_lights_punctual", {{"light", light}}}}}});
    const int places = file.vec3s({0, 0, 1, 0, 0, 2, 0, 0, 3});
    file.root({{"mesh", mesh},
               {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", places}}}}}}}});
    file.json["extensionsUsed"] = {"KHR_lights_punctual", "EXT_mesh_gpu_instancing"};
    return file;
}

}  // namespace

std::string smallPng() {
    std::string bytes;
    stbi_write_png_to_func(append, &bytes, 2, 2, 4, kTexels.data(), 8);
    return bytes;
}

std::string smallJpeg() {
    std::string bytes;
    stbi_write_jpg_to_func(append, &bytes, 2, 2, 4, kTexels.data(), 80);
    return bytes;
}

std::vector<GltfFile> goodFiles() {
    return {GltfFile::triangle(), material(), moving()};
}

bool loadScene(const std::filesystem::path& path, bool strict) {
    constexpr std::uint64_t kMemory = std::uint64_t{1} << 30U;
    limitMemory(kMemory);
    try {
        validateScene(loadGltf(path, {.strict = strict}));
    } catch (const InputError&) {
        return false;
    }
    return true;
}

}  // namespace licht::fuzz
