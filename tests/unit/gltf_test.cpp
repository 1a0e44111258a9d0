// The loader against files that the tests write, with the exact values that must come out.
#include "licht/scene/gltf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../support/gltf_file.h"
#include "licht/core/file.h"
#include "licht/image/files.h"

namespace licht {
namespace {

using test::GltfFile;
using test::Json;
using test::TemporaryFolder;

class Gltf : public testing::Test {
protected:
    Scene load(const GltfFile& file) { return loadGltf(file.writeGlb(folder_)); }

    /// A 2x1 picture, red beside green, as the file `name` in the folder.
    void writePicture(const std::string& name) const {
        Image picture(2, 1, 3);
        picture.texels = {1, 0, 0, 0, 1, 0};
        writePng(folder_.path() / name, picture);
    }

    TemporaryFolder folder_;
};

bool hasNote(const Scene& scene, SceneNote::Kind kind, const std::string& part) {
    return std::any_of(scene.notes.begin(), scene.notes.end(), [&](const SceneNote& note) {
        return note.kind == kind && note.text.find(part) != std::string::npos;
    });
}

std::string notesOf(const Scene& scene) {
    std::string all;
    for (const SceneNote& note : scene.notes) {
        all += note.text + "\n";
    }
    return all;
}

TEST_F(Gltf, ExternalEmbeddedAndBinaryFilesAreTheSame) {
    const GltfFile file = GltfFile::triangle();
    for (const auto& path :
         {file.writeExternal(folder_), file.writeEmbedded(folder_), file.writeGlb(folder_)}) {
        const Scene scene = loadGltf(path);
        EXPECT_NO_THROW(validateScene(scene));
        ASSERT_EQ(scene.meshes.size(), 1U);
        EXPECT_EQ(scene.meshes[0].name, "M");
        EXPECT_EQ(scene.meshes[0].positions, (std::vector<vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
        EXPECT_EQ(scene.meshes[0].triangles, (std::vector<uvec3>{{0, 1, 2}}));
        EXPECT_TRUE(scene.meshes[0].normals.empty());
        EXPECT_EQ(scene.instances.at(0).name, "N");
        EXPECT_EQ(scene.instances.at(0).world_from_object, mat4(1.0F));
        EXPECT_TRUE(scene.notes.empty()) << notesOf(scene);
        // glTF's default material
        ASSERT_EQ(scene.materials.size(), 1U);
        EXPECT_EQ(scene.materials[0].metallic, 1.0F);
        EXPECT_EQ(scene.materials[0].roughness, 1.0F);
    }
}

// Whoever prints a name need not know where it comes from.
TEST_F(Gltf, NamesAreCleanedAtTheEntrance) {
    GltfFile file = GltfFile::triangle();
    file.json["nodes"][0]["name"] =
        "red \x1b[31m\xc2\x9b"
        "1m \xe2\x80\xae"
        "txt\n";
    file.json["meshes"][0]["name"] =
        "a\x07"
        "b";
    file.json["materials"] = Json::array({{{"name",
                                            "c\x01"
                                            "d"}}});
    file.primitive()["material"] = 0;
    const Scene scene = load(file);
    EXPECT_EQ(scene.instances[0].name, "red  [31m 1m  txt");
    EXPECT_EQ(scene.meshes[0].name, "a b");
    EXPECT_EQ(scene.materials[0].name, "c d");
}

TEST_F(Gltf, AFileNameMayBePercentEncodedAndLieDeeper) {
    GltfFile file = GltfFile::triangle();
    folder_.write("a b/c+d.bin", file.binary);
    file.json["buffers"] = Json::array({{{"uri", "a%20b/./c+d.bin"}, {"byteLength", file.binary.size()}}});
    EXPECT_EQ(loadGltf(folder_.write("s.gltf", file.json.dump())).meshes.size(), 1U);
}

TEST_F(Gltf, TheSceneIsChosen) {
    GltfFile file = GltfFile::triangle();
    file.add("nodes", {{"mesh", 0}, {"name", "second"}});
    file.add("scenes", {{"nodes", {1}}});
    EXPECT_EQ(load(file).instances.at(0).name, "N");
    EXPECT_EQ(loadGltf(file.writeGlb(folder_), {1}).instances.at(0).name, "second");
    file.json["scene"] = 1;
    EXPECT_EQ(load(file).instances.at(0).name, "second");
    EXPECT_EQ(loadGltf(file.writeGlb(folder_), {0}).instances.at(0).name, "N");
    file.json.erase("scenes");
    file.json.erase("scene");
    EXPECT_EQ(load(file).instances.size(), 2U);
}

TEST_F(Gltf, NodesMultiplyTransformsAndKeepMirrors) {
    GltfFile file = GltfFile::triangle();
    file.json["nodes"] = Json::array({
        {{"children", {1, 2}},
         {"translation", {10, 0, 0}},
         {"rotation", {0, 0, std::sqrt(0.5), std::sqrt(0.5)}},
         {"scale", {2, 2, 2}}},
        {{"mesh", 0}, {"translation", {1, 0, 0}}},
        {{"mesh", 0}, {"matrix", {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1}}},
    });
    const Scene scene = load(file);
    ASSERT_EQ(scene.instances.size(), 2U);
    EXPECT_EQ(scene.meshes.size(), 1U) << "a mesh placed twice is made once";
    const auto expectNear = [](const vec4& a, const vec4& b) {
        // sqrt(0.5) twice and a few products in double, then rounded to float: half an ulp of values up to 10
        EXPECT_LE(glm::length(a - b), 10.0F * std::numeric_limits<float>::epsilon());
    };
    // A quarter turn about z, scaled by 2: (1,0,0) goes to (0,2,0), then out by 10.
    expectNear(scene.instances[0].world_from_object * vec4(0, 0, 0, 1), vec4(10, 2, 0, 1));
    expectNear(scene.instances[0].world_from_object * vec4(1, 0, 0, 0), vec4(0, 2, 0, 0));
    expectNear(scene.instances[1].world_from_object * vec4(1, 0, 0, 1), vec4(10, -2, 10, 1));
    EXPECT_LT(glm::determinant(glm::mat3(scene.instances[1].world_from_object)), 0.0F);
}

TEST_F(Gltf, EveryPrimitiveMode) {
    const std::vector<std::pair<int, std::vector<uvec3>>> modes{
        {4, {{0, 1, 2}}}, {5, {{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}}, {6, {{1, 2, 0}, {2, 3, 0}, {3, 4, 0}}}};
    for (const auto& [mode, triangles] : modes) {
        GltfFile file;
        const int positions = file.vec3s({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0});
        file.mesh({{"attributes", {{"POSITION", positions}}}, {"mode", mode}});
        file.root({{"mesh", 0}});
        const Scene scene = load(file);
        EXPECT_EQ(scene.meshes.at(0).triangles, triangles) << "mode " << mode;
        EXPECT_EQ(hasNote(scene, SceneNote::Kind::warning, "5 indices make no whole triangles"), mode == 4);
    }
    for (int mode = 0; mode < 4; ++mode) {
        GltfFile file = GltfFile::triangle();
        file.primitive()["mode"] = mode;
        const Scene scene = load(file);
        EXPECT_TRUE(scene.instances.empty());
        EXPECT_TRUE(hasNote(scene, SceneNote::Kind::skipped,
                            mode == 0 ? "points are not drawn" : "lines are not drawn"))
            << notesOf(scene);
    }
}

TEST_F(Gltf, IndicesOfEveryTypeAndStripsWithStitches) {
    const auto expectTriangles = [&](const GltfFile& file) {
        EXPECT_EQ(load(file).meshes.at(0).triangles, (std::vector<uvec3>{{2, 1, 0}}));
    };
    GltfFile bytes = GltfFile::triangle();
    bytes.primitive()["indices"] = bytes.accessor<std::uint8_t>({2, 1, 0}, test::kUnsignedByte, "SCALAR", 3);
    expectTriangles(bytes);
    GltfFile shorts = GltfFile::triangle();
    shorts.primitive()["indices"] = shorts.indices({2, 1, 0});
    expectTriangles(shorts);
    GltfFile words = GltfFile::triangle();
    words.primitive()["indices"] = words.accessor<std::uint32_t>({2, 1, 0}, test::kUnsignedInt, "SCALAR", 3);
    expectTriangles(words);
    GltfFile strip = GltfFile::triangle();
    strip.primitive()["indices"] = strip.indices({2, 1, 0, 0});
    strip.primitive()["mode"] = 5;
    expectTriangles(strip);
}

TEST_F(Gltf, InterleavedNormalisedAndQuantisedAttributes) {
    GltfFile file;
    // Per vertex: position as three shorts, padding, colour as four normalised bytes: 12 bytes.
    std::string bytes;
    for (const std::array<std::int16_t, 3>& p :
         {std::array<std::int16_t, 3>{0, 0, 0}, {300, 0, -5}, {0, 7, 0}}) {
        bytes += test::bytesOf(std::span<const std::int16_t>(p)) + std::string(2, '\0') +
                 std::string("\xff\x00\x33\x80", 4);
    }
    const int view = file.view(bytes, 12);
    const int positions = file.add(
        "accessors", {{"bufferView", view}, {"componentType", test::kShort}, {"count", 3}, {"type", "VEC3"}});
    const int colors = file.add("accessors", {{"bufferView", view},
                                              {"byteOffset", 8},
                                              {"componentType", test::kUnsignedByte},
                                              {"count", 3},
                                              {"type", "VEC4"},
                                              {"normalized", true}});
    const int normals =
        file.accessor<std::int8_t>({0, 0, 127, 0, 0, -128, 127, 0, 0, 0, 0, 0}, test::kByte, "VEC3", 3, true);
    file.json["accessors"][static_cast<std::size_t>(normals)]["count"] = 3;
    const int uvs =
        file.accessor<std::uint16_t>({0, 65535, 65535, 0, 13107, 0}, test::kUnsignedShort, "VEC2", 3, true);
    file.json["extensionsUsed"] = {"KHR_mesh_quantization"};
    file.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    file.mesh({{"attributes",
                {{"POSITION", positions}, {"COLOR_0", colors}, {"NORMAL", normals}, {"TEXCOORD_0", uvs}}}});
    file.root({{"mesh", 0}});
    const Scene scene = load(file);
    const Mesh& mesh = scene.meshes.at(0);
    EXPECT_EQ(mesh.positions, (std::vector<vec3>{{0, 0, 0}, {300, 0, -5}, {0, 7, 0}}));
    EXPECT_EQ(mesh.colors.at(2), vec4(1.0F, 0.0F, 51.0F / 255.0F, 128.0F / 255.0F));
    EXPECT_EQ(mesh.normals, (std::vector<vec3>{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}}));
    EXPECT_EQ(mesh.uv_sets.at(0), (std::vector<vec2>{{0, 1}, {1, 0}, {0.2F, 0}}));
    EXPECT_TRUE(scene.notes.empty()) << notesOf(scene);
}

TEST_F(Gltf, SparseAccessorsWithAndWithoutABase) {
    GltfFile file = GltfFile::triangle();
    const std::vector<std::uint16_t> where{2};
    const std::vector<float> what{5, 6, 7};
    const Json sparse{{"count", 1},
                      {"indices",
                       {{"bufferView", file.view(test::bytesOf(std::span(where)))},
                        {"componentType", test::kUnsignedShort}}},
                      {"values", {{"bufferView", file.view(test::bytesOf(std::span(what)))}}}};
    file.json["accessors"][0]["sparse"] = sparse;
    EXPECT_EQ(load(file).meshes.at(0).positions, (std::vector<vec3>{{0, 0, 0}, {1, 0, 0}, {5, 6, 7}}));
    file.json["accessors"][0].erase("bufferView");
    EXPECT_EQ(load(file).meshes.at(0).positions, (std::vector<vec3>{{0, 0, 0}, {0, 0, 0}, {5, 6, 7}}));
}

TEST_F(Gltf, ColoursOfThreeComponentsAreOpaqueAndClamped) {
    GltfFile file = GltfFile::triangle();
    file.primitive()["attributes"]["COLOR_0"] = file.vec3s({0, 0.25F, 0.5F, 1, 2, -1, 0, 0, 0});
    const Scene scene = load(file);
    EXPECT_EQ(scene.meshes.at(0).colors,
              (std::vector<vec4>{{0, 0.25F, 0.5F, 1}, {1, 1, 0, 1}, {0, 0, 0, 1}}));
    EXPECT_TRUE(hasNote(scene, SceneNote::Kind::warning, "COLOR_0 leaves [0,1]"));
}

TEST_F(Gltf, SetsOfCoordinatesKeepTheirNumber) {
    GltfFile file = GltfFile::triangle();
    file.primitive()["attributes"]["TEXCOORD_1"] = file.vec2s({0, 0, 1, 0, 0, 1});
    const Scene scene = load(file);
    ASSERT_EQ(scene.meshes.at(0).uv_sets.size(), 2U);
    EXPECT_TRUE(scene.meshes[0].uv_sets[0].empty());
    EXPECT_EQ(scene.meshes[0].uv_sets[1].at(1), vec2(1, 0));
}

TEST_F(Gltf, MorphTargetsGiveTheRestPose) {
    GltfFile file = GltfFile::triangle();
    const int target = file.vec3s({0, 0, 4, 0, 0, 0, 2, 0, 0});
    file.primitive()["targets"] = Json::array({{{"POSITION", target}}});
    file.root({{"mesh", 0}, {"weights", {1.0}}});
    EXPECT_EQ(load(file).meshes.at(0).positions.at(0), vec3(0, 0, 0)) << "without weights nothing moves";
    file.json["meshes"][0]["weights"] = {0.5};
    const Scene scene = load(file);
    ASSERT_EQ(scene.meshes.size(), 2U);
    EXPECT_EQ(scene.meshes[0].positions, (std::vector<vec3>{{0, 0, 2}, {1, 0, 0}, {1, 1, 0}}));
    EXPECT_EQ(scene.meshes[1].positions, (std::vector<vec3>{{0, 0, 4}, {1, 0, 0}, {2, 1, 0}}))
        << "the node's weights win";
}

TEST_F(Gltf, SkinsHoldVerticesWhereTheirJointsAre) {
    GltfFile file = GltfFile::triangle();
    file.primitive()["attributes"]["JOINTS_0"] =
        file.accessor<std::uint8_t>({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, test::kUnsignedByte, "VEC4", 3);
    file.primitive()["attributes"]["WEIGHTS_0"] = file.vec4s({1, 0, 0, 0, 1, 0, 0, 0, 0.5F, 0.5F, 0, 0});
    file.primitive()["attributes"]["NORMAL"] = file.vec3s({0, 0, 1, 0, 0, 1, 0, 0, 1});
    file.json["nodes"][0]["skin"] = 0;
    file.json["nodes"][0]["translation"] = {100, 100, 100};  // does not count
    const int first = file.root({{"translation", {0, 0, 1}}});
    const int second = file.root({{"translation", {0, 0, 5}}, {"scale", {2, 2, 1}}});
    std::vector<float> bind(32, 0.0F);
    for (std::size_t j = 0; j < 2; ++j) {
        for (std::size_t d = 0; d < 4; ++d) {
            bind[16 * j + 5 * d] = 1.0F;
        }
    }
    bind[16 + 12] = 3.0F;  // the second joint's bind pose lies at x = -3
    const int matrices = file.accessor(bind, test::kFloat, "MAT4", 2);
    file.json["skins"] = Json::array({{{"joints", {first, second}}, {"inverseBindMatrices", matrices}}});
    file.json["animations"] = Json::array({{{"channels", Json::array()}, {"samplers", Json::array()}}});
    const Scene scene = load(file);
    const Mesh& mesh = scene.meshes.at(0);
    EXPECT_EQ(scene.instances.at(0).world_from_object, mat4(1.0F));
    // Vertex 1 = (1,0,0) + 3 in x, scaled by 2, moved by 5. Vertex 2 is halfway between (0,1,1) and (6,2,5).
    EXPECT_EQ(mesh.positions, (std::vector<vec3>{{0, 0, 1}, {8, 0, 5}, {3, 1.5F, 3}}));
    EXPECT_EQ(mesh.normals, std::vector<vec3>(3, vec3(0, 0, 1)));
    EXPECT_TRUE(hasNote(scene, SceneNote::Kind::skipped, "1 animations are not played"));
}

TEST_F(Gltf, MaterialsWithEveryFactorAndExtension) {
    writePicture("p.png");
    GltfFile file = GltfFile::triangle();
    file.primitive()["material"] = 1;
    file.primitive()["attributes"]["TEXCOORD_0"] = file.vec2s({0, 0, 1, 0, 0, 1});
    file.json["images"] = Json::array({{{"uri", "p.png"}, {"name", "P"}}});
    file.json["samplers"] = Json::array({{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}});
    file.json["textures"] = Json::array({{{"source", 0}}, {{"source", 0}, {"sampler", 0}}});
    const Json transform{
        {"KHR_texture_transform",
         {{"offset", {0.25, 0.5}}, {"rotation", 0.39269908}, {"scale", {1.5, 3}}, {"texCoord", 0}}}};
    file.json["materials"] = Json::array(
        {{{"name", "unused"}},
         {{"name", "Glass"},
          {"pbrMetallicRoughness",
           {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}},
            {"metallicFactor", 0.5},
            {"roughnessFactor", 0.25},
            {"baseColorTexture", {{"index", 1}}},
            {"metallicRoughnessTexture", {{"index", 0}, {"texCoord", 1}, {"extensions", transform}}}}},
          {"normalTexture", {{"index", 0}, {"scale", 0.75}}},
          {"occlusionTexture", {{"index", 0}}},
          {"emissiveTexture", {{"index", 0}}},
          {"emissiveFactor", {1, 0.5, 0}},
          {"alphaMode", "MASK"},
          {"alphaCutoff", 0.3},
          {"doubleSided", true},
          {"extensions",
           {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8}}},
            {"KHR_materials_ior", {{"ior", 1.75}}},
            {"KHR_materials_specular",
             {{"specularFactor", 0.5},
              {"specularColorFactor", {1, 2, 0}},
              {"specularTexture", {{"index", 0}}},
              {"specularColorTexture", {{"index", 1}}}}}}}}});
    const Scene scene = loadGltf(file.writeExternal(folder_));
    EXPECT_NO_THROW(validateScene(scene));
    EXPECT_TRUE(scene.notes.empty()) << notesOf(scene);
    ASSERT_EQ(scene.materials.size(), 1U) << "only what is used";
    const Material& m = scene.materials[0];
    EXPECT_EQ(m.name, "Glass");
    EXPECT_EQ(m.base_color, vec4(0.1F, 0.2F, 0.3F, 0.4F));
    EXPECT_EQ(m.metallic, 0.5F);
    EXPECT_EQ(m.roughness, 0.25F);
    EXPECT_EQ(m.emission, vec3(8, 4, 0));
    EXPECT_EQ(m.normal_scale, 0.75F);
    EXPECT_EQ(m.alpha_mode, AlphaMode::mask);
    EXPECT_EQ(m.alpha_cutoff, 0.3F);
    EXPECT_TRUE(m.double_sided);
    EXPECT_FALSE(m.unlit);
    EXPECT_EQ(m.ior, 1.75F);
    EXPECT_EQ(m.specular, 0.5F);
    EXPECT_EQ(m.specular_color, vec3(1, 2, 0));
    EXPECT_TRUE(m.slots[kSlotSpecular].present() && m.slots[kSlotSpecularColor].present() &&
                m.slots[kSlotEmissive].present());
    EXPECT_EQ(m.slots[kSlotBaseColor].wrap_u, Wrap::clamp);
    EXPECT_EQ(m.slots[kSlotBaseColor].wrap_v, Wrap::mirror);
    EXPECT_FALSE(m.slots[kSlotBaseColor].linear);
    EXPECT_EQ(m.slots[kSlotNormal].wrap_u, Wrap::repeat);
    EXPECT_TRUE(m.slots[kSlotNormal].linear);
    // The picture is decoded once, and its bytes are what the file holds.
    ASSERT_EQ(scene.textures.size(), 1U);
    EXPECT_EQ(scene.textures[0].name, "P");
    EXPECT_EQ(scene.textures[0].width, 2U);
    EXPECT_EQ(scene.textures[0].height, 1U);
    EXPECT_EQ(scene.textures[0].bytes, (std::vector<std::uint8_t>{255, 0, 0, 255, 0, 255, 0, 255}));
    // Scale, then rotation, then offset.
    const TextureSlot& slot = m.slots[kSlotMetallicRoughness];
    EXPECT_EQ(slot.uv_set, 0U) << "the transform's texCoord wins";
    const double c = std::cos(0.39269908);
    const double s = std::sin(0.39269908);
    for (int i = 0; i < 3; ++i) {
        EXPECT_FLOAT_EQ(slot.u_from_uv[i],
                        static_cast<float>(std::array{1.5 * c, 3 * s, 0.25}.at(static_cast<std::size_t>(i))));
        EXPECT_FLOAT_EQ(slot.v_from_uv[i],
                        static_cast<float>(std::array{-1.5 * s, 3 * c, 0.5}.at(static_cast<std::size_t>(i))));
    }
    // The normal map's tangents are derived: the coordinates grow with x and y, so up in the picture is -y.
    EXPECT_EQ(scene.meshes[0].tangents.at(0), vec4(1, 0, 0, -1));
}

TEST_F(Gltf, ThePublishedRotationTest) {
    // Khronos' TextureTransformTest places the tip of an arrow, at (7/9, 7/9) of its picture, where a quad
    // turned by pi/8 must show it.
    writePicture("p.png");
    GltfFile file = GltfFile::triangle();
    file.primitive()["material"] = 0;
    file.primitive()["attributes"]["TEXCOORD_0"] = file.vec2s({0, 0, 1, 0, 0, 1});
    file.json["images"] = Json::array({{{"uri", "p.png"}}});
    file.json["textures"] = Json::array({{{"source", 0}}});
    file.json["materials"] = Json::array(
        {{{"pbrMetallicRoughness",
           {{"baseColorTexture",
             {{"index", 0},
              {"extensions", {{"KHR_texture_transform", {{"rotation", 0.39269908169872414}}}}}}}}}}});
    const TextureSlot slot = loadGltf(file.writeExternal(folder_)).materials.at(0).slots[kSlotBaseColor];
    const vec3 where(0.5F - 0.0790482244F, 0.5F + 0.5162674858F, 1.0F);
    // The published positions are rounded sines and cosines in float.
    EXPECT_NEAR(glm::dot(slot.u_from_uv, where), 0.5F + 0.2778174593F,
                4.0F * std::numeric_limits<float>::epsilon());
    EXPECT_NEAR(glm::dot(slot.v_from_uv, where), 0.5F + 0.2778174593F,
                4.0F * std::numeric_limits<float>::epsilon());
}

TEST_F(Gltf, PicturesOfBufferViewsAndDataUris) {
    writePicture("p.png");
    const std::vector<std::byte> bytes = readFile(folder_.path() / "p.png");
    const std::string png(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    GltfFile file = GltfFile::triangle();
    file.primitive()["material"] = 0;
    file.primitive()["attributes"]["TEXCOORD_0"] = file.vec2s({0, 0, 1, 0, 0, 1});
    file.json["images"] = Json::array({{{"bufferView", file.view(png)}, {"mimeType", "image/png"}},
                                       {{"uri", "data:image/png;base64," + test::base64(png)}},
                                       {{"uri", "nobody-uses-it.png"}}});
    file.json["textures"] = Json::array({{{"source", 0}}, {{"source", 1}}, {{"source", 2}}});
    file.json["materials"] = Json::array({{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}},
                                           {"emissiveTexture", {{"index", 1}}}}});
    const Scene scene = load(file);
    // The same bytes, wherever they come from, are decoded once.
    ASSERT_EQ(scene.textures.size(), 1U);
    EXPECT_EQ(scene.textures[0].bytes, (std::vector<std::uint8_t>{255, 0, 0, 255, 0, 255, 0, 255}));
    EXPECT_EQ(scene.materials[0].slots[kSlotBaseColor].texture, 0U);
    EXPECT_EQ(scene.materials[0].slots[kSlotEmissive].texture, 0U);
}

TEST_F(Gltf, CoordinatesThatAMaterialReadsAreThere) {
    writePicture("p.png");
    GltfFile file = GltfFile::triangle();
    file.primitive()["material"] = 0;
    file.json["images"] = Json::array({{{"uri", "p.png"}}});
    file.json["textures"] = Json::array({{{"source", 0}}});
    file.json["materials"] = Json::array({{{"normalTexture", {{"index", 0}, {"texCoord", 1}}}}});
    const Scene scene = loadGltf(file.writeExternal(folder_));
    EXPECT_EQ(scene.meshes.at(0).uv_sets.at(1), std::vector<vec2>(3, vec2(0.0F)));
    EXPECT_EQ(scene.meshes[0].tangents.size(), 3U);
    EXPECT_TRUE(hasNote(scene, SceneNote::Kind::warning, "reads TEXCOORD_1, which is not there"));
}

TEST_F(Gltf, FactorsOutOfRangeAreClampedWithAWarning) {
    GltfFile file = GltfFile::triangle();
    file.primitive()["material"] = 0;
    file.json["materials"] = Json::array(
        {{{"pbrMetallicRoughness",
           {{"baseColorFactor", {2, 0.5, -1, 1}}, {"metallicFactor", 7}, {"roughnessFactor", -0.5}}},
          {"emissiveFactor", {-1, 0, 0}},
          {"extensions", {{"KHR_materials_ior", {{"ior", 0.5}}}, {"KHR_materials_unlit", Json::object()}}}}});
    const Scene scene = load(file);
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(m.base_color, vec4(1, 0.5F, 0, 1));
    EXPECT_EQ(m.metallic, 1.0F);
    EXPECT_EQ(m.roughness, 0.0F);
    EXPECT_EQ(m.emission, vec3(0.0F));
    EXPECT_EQ(m.ior, 1.0F);
    EXPECT_TRUE(m.unlit);
    for (const char* what : {"baseColorFactor 2", "baseColorFactor -1", "metallicFactor 7",
                             "roughnessFactor -0.5", "emissiveFactor -1", "ior 0.5"}) {
        EXPECT_TRUE(hasNote(scene, SceneNote::Kind::warning, what)) << what;
    }
}

TEST_F(Gltf, CamerasStandWhereTheirNodesDo) {
    GltfFile file = GltfFile::triangle();
    file.json["cameras"] =
        Json::array({{{"type", "perspective"},
                      {"name", "eye"},
                      {"perspective", {{"yfov", 0.5}, {"znear", 0.1}, {"aspectRatio", 2}}}},
                     {{"type", "orthographic"},
                      {"orthographic", {{"xmag", 3}, {"ymag", 1.5}, {"znear", 0.2}, {"zfar", 10}}}},
                     {{"type", "perspective"}, {"perspective", {{"yfov", 4.0}, {"znear", 0.1}}}}});
    file.root({{"camera", 0}, {"translation", {1, 2, 3}}, {"scale", {5, 1, 2}}});
    file.root({{"camera", 1}, {"name", "plan"}, {"rotation", {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)}}});
    file.root({{"camera", 2}});
    const Scene scene = load(file);
    ASSERT_EQ(scene.cameras.size(), 2U);
    EXPECT_EQ(scene.cameras[0].name, "eye");
    EXPECT_EQ(scene.cameras[0].y_fov, 0.5F);
    EXPECT_EQ(scene.cameras[0].aspect, 2.0F);
    EXPECT_EQ(scene.cameras[0].z_near, 0.1F);
    EXPECT_EQ(scene.cameras[0].world_from_view, glm::translate(mat4(1.0F), vec3(1, 2, 3)))
        << "a camera has no scale";
    EXPECT_EQ(scene.cameras[1].name, "plan");
    EXPECT_EQ(scene.cameras[1].kind, Camera::Kind::orthographic);
    EXPECT_EQ(scene.cameras[1].y_extent, 1.5F);
    EXPECT_EQ(scene.cameras[1].aspect, 2.0F);
    // Turned down by a quarter: it looks along -Y. sqrt(0.5) is rounded once in double, so float sees the
    // exact direction within an ulp.
    EXPECT_NEAR(scene.cameras[1].world_from_view[2].y, 1.0F, std::numeric_limits<float>::epsilon());
    EXPECT_TRUE(hasNote(scene, SceneNote::Kind::skipped, "camera 2"));
}

TEST_F(Gltf, PunctualLights) {
    GltfFile file = GltfFile::triangle();
    file.json["extensionsUsed"] = {"KHR_lights_punctual"};
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array(
        {{{"type", "point"}, {"name", "bulb"}, {"color", {1, 0.5, 0}}, {"intensity", 10}, {"range", 4}},
         {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.4}}}},
         {{"type", "directional"}, {"intensity", -3}},
         {{"type", "laser"}}});
    for (int light = 0; light < 4; ++light) {
        file.root({{"translation", {1, 2, 3}},
                   {"scale", {2, 2, 2}},
                   {"extensions", {{"KHR_lights_punctual", {{"light", light}}}}}});
    }
    const Scene scene = load(file);
    EXPECT_NO_THROW(validateScene(scene));
    ASSERT_EQ(scene.lights.size(), 3U);
    EXPECT_EQ(scene.lights[0].name, "bulb");
    EXPECT_EQ(scene.lights[0].intensity, vec3(10, 5, 0));
    EXPECT_EQ(scene.lights[0].position, vec3(1, 2, 3));
    EXPECT_EQ(scene.lights[0].range, 4.0F);
    EXPECT_EQ(scene.lights[1].kind, PunctualLight::Kind::spot);
    EXPECT_EQ(scene.lights[1].inner_cone, 0.2F);
    EXPECT_EQ(scene.lights[1].outer_cone, 0.4F);
    EXPECT_EQ(scene.lights[1].direction, vec3(0, 0, -1));
    EXPECT_EQ(scene.lights[1].range, 0.0F);
    EXPECT_EQ(scene.lights[2].intensity, vec3(0.0F));
    EXPECT_TRUE(hasNote(scene, SceneNote::Kind::warning, "intensity is outside of its range"));
    EXPECT_TRUE(hasNote(scene, SceneNote::Kind::skipped, "type 'laser' is unknown"));
}

TEST_F(Gltf, OptionalExtensionsThatAreUnknownWarnOnce) {
    GltfFile file = GltfFile::triangle();
    file.json["extensionsUsed"] = {"KHR_materials_sheen", "EXT_texture_webp", "KHR_draco_mesh_compression"};
    file.primitive()["material"] = 0;
    file.primitive()["extensions"] = {
        {"KHR_draco_mesh_compression", {{"bufferView", 0}, {"attributes", Json::object()}}}};
    file.json["materials"] =
        Json::array({{{"extensions", {{"KHR_materials_sheen", {{"sheenRoughnessFactor", 1}}}}}}});
    const Scene scene = load(file);
    EXPECT_EQ(scene.notes.size(), 3U) << notesOf(scene);
    EXPECT_EQ(scene.meshes.at(0).triangles.size(), 1U) << "the uncompressed accessors are used";
}

TEST_F(Gltf, ADeepChainOfNodesLoads) {
    constexpr int kDepth = 100000;
    GltfFile file = GltfFile::triangle();
    Json nodes = Json::array();
    for (int i = 0; i + 1 < kDepth; ++i) {
        nodes.push_back({{"children", {i + 1}}, {"translation", {1, 0, 0}}});
    }
    nodes.push_back({{"mesh", 0}});
    file.json["nodes"] = nodes;
    // So far out that it becomes the origin.
    const Scene scene = load(file);
    EXPECT_EQ(scene.origin + glm::dvec3(vec3(scene.instances.at(0).world_from_object[3])),
              glm::dvec3(kDepth - 1, 0, 0));
}

TEST_F(Gltf, WhatCannotBeDrawnIsSkippedWithAReason) {
    const std::vector<std::pair<Json, std::string>> nodes{
        {{{"mesh", 0}, {"matrix", std::vector<int>(16, 0)}}, "node 1: its transform is not affine"},
        {{{"mesh", 0}, {"scale", {1, 0, 1}}}, "node 1: its transform flattens it"},
        {{{"mesh", 0}, {"translation", {1e300, 0, 0}}}, "node 1: its transform is not finite or too large"},
        {{{"mesh", 0}, {"scale", {1e300, 1, 1}}}, "node 1: its transform is not finite or too large"},
    };
    for (const auto& [node, reason] : nodes) {
        GltfFile file = GltfFile::triangle();
        file.root(node);
        const Scene scene = load(file);
        EXPECT_EQ(scene.instances.size(), 1U);
        EXPECT_TRUE(hasNote(scene, SceneNote::Kind::skipped, reason)) << notesOf(scene);
    }
    GltfFile bare = GltfFile::triangle();
    bare.primitive()["attributes"] = {{"NORMAL", 0}};
    EXPECT_TRUE(hasNote(load(bare), SceneNote::Kind::skipped, "it has no POSITION"));
}

TEST_F(Gltf, AZeroQuaternionIsNoRotation) {
    GltfFile file = GltfFile::triangle();
    file.json["nodes"][0]["rotation"] = {0, 0, 0, 0};
    const Scene scene = load(file);
    EXPECT_EQ(scene.instances.at(0).world_from_object, mat4(1.0F));
    EXPECT_TRUE(hasNote(scene, SceneNote::Kind::warning, "node 0 'N': its rotation"));
}

TEST_F(Gltf, TrianglesOfVerticesThatAreNoPlaceAreLeftOut) {
    GltfFile file;
    const int positions = file.vec3s({0, 0, 0, 1, 0, 0, 0, 1, 0, std::nanf(""), 0, 0, 1e19F, 0, 0});
    file.mesh(
        {{"attributes", {{"POSITION", positions}}}, {"indices", file.indices({0, 1, 2, 0, 1, 3, 0, 1, 4})}});
    file.root({{"mesh", 0}});
    const Scene scene = load(file);
    EXPECT_EQ(scene.meshes.at(0).triangles, (std::vector<uvec3>{{0, 1, 2}}));
    EXPECT_EQ(scene.meshes[0].positions.size(), 5U);
    EXPECT_TRUE(hasNote(scene, SceneNote::Kind::warning, "2 triangles with a vertex that is not finite"))
        << notesOf(scene);
}

}  // namespace
}  // namespace licht
