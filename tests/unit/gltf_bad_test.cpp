// Damaged and hostile files: each must end in one line that names the file and the object, never in a crash
// or in a read outside.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <functional>

#include "../support/gltf_file.h"
#include "licht/core/error.h"
#include "licht/scene/gltf.h"

namespace licht {
namespace {

using test::GltfFile;
using test::Json;
using test::TemporaryFolder;

namespace fs = std::filesystem;

/// The message of the InputError; any other outcome fails the test.
std::string errorOf(const fs::path& path, std::optional<std::uint32_t> scene = std::nullopt) {
    try {
        loadGltf(path, {scene, true});
    } catch (const InputError& e) {
        const std::string text = e.what();
        EXPECT_EQ(text.find('\n'), std::string::npos) << text;
        EXPECT_EQ(text.rfind(path.string(), 0), 0U) << text;
        EXPECT_LT(text.size(), 600U) << text;
        return text;
    }
    ADD_FAILURE() << "loaded: " << path;
    return {};
}

void expectError(const fs::path& path, const std::string& part) {
    const std::string text = errorOf(path);
    EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in: " << text;
}

class BadGltf : public testing::Test {
protected:
    void expect(const GltfFile& file, const std::string& part) {
        expectError(file.writeGlb(folder_), part);
        expectError(file.writeExternal(folder_), part);
    }
    TemporaryFolder folder_;
};

TEST_F(BadGltf, NoFileAFolderAnEmptyFileAndNoise) {
    expectError(folder_.path() / "missing.gltf", "");
    fs::create_directories(folder_.path() / "folder.glb");
    expectError(folder_.path() / "folder.glb", "");
    expectError(folder_.write("empty.gltf", ""), "the file is empty");
    for (const char* text : {"g", "{", "[]", "null", "{}", "{\"asset\":[]}", "{\"asset\":{\"version\":2}}",
                             "\xff\xfe\xfd", "{\"a\":\"\n\"}"}) {
        expectError(folder_.write("noise.gltf", text), "no glTF");
    }
    expectError(folder_.write("old.gltf", R"({"asset":{"version":"1.0"}})"), "version 1.0 is not supported");
    expectError(folder_.write("new.gltf", R"({"asset":{"version":"2.1","minVersion":"2.1"}})"),
                "version 2.1 is not supported");
}

TEST_F(BadGltf, JsonNestedDeeperThanAnyStack) {
    std::string text = R"({"asset":{"version":"2.0"},"extras":)";
    text += std::string(1000000, '[');
    expectError(folder_.write("deep.gltf", text), "nested deeper");
    expectError(folder_.write("deep.gltf", text + std::string(1000000, ']') + "}"), "nested deeper");
    const std::string harmless =
        R"({"asset":{"version":"2.0"},"extras":"\"\\)" + std::string(1000, '[') + "\"}";
    EXPECT_NO_THROW(loadGltf(folder_.write("flat.gltf", harmless)));
}

TEST_F(BadGltf, AGlbCutAtEveryLength) {
    const GltfFile file = GltfFile::triangle();
    const std::string whole = test::glb(file.withBuffer("").dump(), file.binary);
    for (std::size_t length = 0; length < whole.size(); ++length) {
        errorOf(folder_.write("cut.glb", std::string_view(whole).substr(0, length)));
    }
    EXPECT_NO_THROW(loadGltf(folder_.write("whole.glb", whole)));
}

TEST_F(BadGltf, AGlbWhoseHeadersLie) {
    const GltfFile file = GltfFile::triangle();
    const std::string whole = test::glb(file.withBuffer("").dump(), file.binary);
    const auto json_size =
        static_cast<unsigned char>(whole[12]) + 256U * static_cast<unsigned char>(whole[13]);
    for (const std::size_t word :
         {std::size_t{4}, std::size_t{8}, std::size_t{12}, std::size_t{16}, std::size_t{20 + json_size}}) {
        for (const char* value : {"\xff\xff\xff\xff", "\xfc\xff\xff\xff", "\x01\x00\x00\x80"}) {
            std::string spoilt = whole;
            spoilt.replace(word, 4, value, 4);
            errorOf(folder_.write("lie.glb", spoilt));
        }
    }
    expectError(folder_.write("length.glb", std::string(whole).replace(8, 4, "\xff\xff\xff\xff", 4)),
                "its header says 4294967295 bytes");
    // A chunk that ends eight bytes beyond the file, by the length of its own header.
    std::string beyond = whole;
    beyond[20 + json_size] = static_cast<char>(beyond[20 + json_size] + 8);
    expectError(folder_.write("beyond.glb", beyond), "does not fit into the file");
}

TEST_F(BadGltf, AccessorsOutOfTheirBuffers) {
    const std::vector<std::pair<std::string, std::function<void(Json&)>>> faults{
        {"do not fit into the 36 bytes", [](Json& j) { j["accessors"][0]["count"] = 4; }},
        {"elements are too many", [](Json& j) { j["accessors"][0]["count"] = std::uint64_t{1} << 62U; }},
        {"elements are too many", [](Json& j) { j["accessors"][0]["count"] = UINT64_MAX; }},
        {"do not fit", [](Json& j) { j["accessors"][0]["byteOffset"] = UINT64_MAX - 35; }},
        {"do not fit", [](Json& j) { j["accessors"][0]["byteOffset"] = UINT64_MAX; }},
        {"do not fit", [](Json& j) { j["accessors"][0]["byteOffset"] = 4; }},
        {"accessor 0: count is -3, no whole number", [](Json& j) { j["accessors"][0]["count"] = -3; }},
        {"byteOffset is -4, no whole number", [](Json& j) { j["accessors"][0]["byteOffset"] = -4; }},
        {"byteOffset is \"4\", no whole number", [](Json& j) { j["accessors"][0]["byteOffset"] = "4"; }},
        {"buffer view 0: byteStride is 12.5", [](Json& j) { j["bufferViews"][0]["byteStride"] = 12.5; }},
        {"do not fit", [](Json& j) { j["bufferViews"][0]["byteStride"] = 252; }},
        {"reaches beyond the 36 bytes of buffer 0",
         [](Json& j) { j["bufferViews"][0]["byteOffset"] = UINT64_MAX - 35; }},
        {"reaches beyond the 36 bytes of buffer 0",
         [](Json& j) { j["bufferViews"][0]["byteLength"] = UINT64_MAX; }},
        {"buffer 1 is not there", [](Json& j) { j["bufferViews"][0]["buffer"] = 1; }},
        {"buffer -1 is not there", [](Json& j) { j["bufferViews"][0]["buffer"] = -1; }},
        {"buffer view 7 is not there", [](Json& j) { j["accessors"][0]["bufferView"] = 7; }},
        {"accessor 9 is not there",
         [](Json& j) { j["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 9; }},
        {"accessor -2 is not there",
         [](Json& j) { j["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = -2; }},
        {"component type 5124 is not allowed", [](Json& j) { j["accessors"][0]["componentType"] = 5124; }},
        {"component type 5130 is not allowed", [](Json& j) { j["accessors"][0]["componentType"] = 5130; }},
        {"it has 2 components, 3 are wanted", [](Json& j) { j["accessors"][0]["type"] = "VEC2"; }},
        {"it has 16 components, 3 are wanted", [](Json& j) { j["accessors"][0]["type"] = "MAT4"; }},
        {"Unsupported `type`", [](Json& j) { j["accessors"][0]["type"] = "VEC9"; }},
        {"at most 16777216 are believed",
         [](Json& j) {
             j["accessors"][0].erase("bufferView");
             j["accessors"][0]["count"] = 1000000000;
         }},
        {"NORMAL has 2 elements, POSITION has 3",
         [](Json& j) {
             j["accessors"].push_back(j["accessors"][0]);
             j["accessors"][1]["count"] = 2;
             j["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 1;
         }},
    };
    for (const auto& [part, spoil] : faults) {
        GltfFile file = GltfFile::triangle();
        spoil(file.json);
        SCOPED_TRACE(file.json.dump());
        expect(file, part);
    }
}

TEST_F(BadGltf, IndicesThatNameNoVertex) {
    GltfFile file = GltfFile::triangle();
    file.primitive()["indices"] = file.indices({0, 1, 3});
    expect(file, "mesh 0 'M' primitive 0: index 3 at position 2 names no vertex, there are 3");
    file.primitive()["indices"] = file.accessor<float>({0, 1, 2}, test::kFloat, "SCALAR", 3);
    expect(file, "component type 5126 is not allowed");
    file.primitive()["indices"] = 77;
    expect(file, "accessor");
}

// 2^32 is 0 where 32 bits are kept, and a fraction or a huge number none: another mesh or none would be drawn
// without a word.
TEST_F(BadGltf, IndicesThatAreNone) {
    const std::vector<std::string> places{"/nodes/0/mesh",
                                          "/nodes/0/children/0",
                                          "/nodes/0/extensions/KHR_lights_punctual/light",
                                          "/scenes/0/nodes/0",
                                          "/scene",
                                          "/meshes/0/primitives/0/material",
                                          "/meshes/0/primitives/0/indices",
                                          "/meshes/0/primitives/0/attributes/POSITION",
                                          "/meshes/0/primitives/0/targets/0/POSITION",
                                          "/accessors/0/bufferView",
                                          "/materials/0/normalTexture/index",
                                          "/textures/0/source"};
    for (const std::string& place : places) {
        for (const Json& number : {Json(4294967296), Json(-4294967296), Json(0.5), Json(1e308)}) {
            GltfFile file = GltfFile::triangle();
            file.json[Json::json_pointer(place)] = number;
            expectError(file.writeGlb(folder_), number.dump() + " is no index");
        }
    }
    GltfFile file = GltfFile::triangle();
    file.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = "sun";
    expect(file, "its light is no index");
    // What is not ours may say anything.
    file = GltfFile::triangle();
    file.json["nodes"][0]["extras"]["mesh"] = 0.5;
    file.json["nodes"][0]["extensions"]["ANY_thing"]["light"] = 1e308;
    loadGltf(file.writeGlb(folder_));
}

TEST_F(BadGltf, SparsePartsThatLie) {
    const auto spoilt = [](const char* part, const char* key, const Json& value, std::uint16_t index = 2) {
        GltfFile file = GltfFile::triangle();
        const std::vector<std::uint16_t> where{index};
        const std::vector<float> what{5, 6, 7};
        Json sparse{{"count", 1},
                    {"indices",
                     {{"bufferView", file.view(test::bytesOf(std::span(where)))},
                      {"componentType", test::kUnsignedShort}}},
                    {"values", {{"bufferView", file.view(test::bytesOf(std::span(what)))}}}};
        (part == nullptr ? sparse : sparse[part])[key] = value;
        file.json["accessors"][0]["sparse"] = sparse;
        return file;
    };
    expect(spoilt(nullptr, "count", 4), "its sparse part is damaged");
    expect(spoilt(nullptr, "count", -1), "accessor 0: sparse.count is -1, no whole number");
    expect(spoilt(nullptr, "count", (std::uint64_t{1} << 32U) + 1), "sparse.count is 4294967297, no whole");
    expect(spoilt(nullptr, "count", 2), "do not fit");
    expect(spoilt("indices", "byteOffset", -4), "sparse.indices.byteOffset is -4, no whole number");
    expect(spoilt("values", "byteOffset", 0.5), "sparse.values.byteOffset is 0.5, no whole number");
    expect(spoilt("indices", "byteOffset", 2147483647), "do not fit");
    expect(spoilt("indices", "componentType", test::kFloat), "its sparse part is damaged");
    expect(spoilt("indices", "componentType", test::kUnsignedInt), "do not fit");
    expect(spoilt("indices", "byteOffset", 0, 3), "sparse index 3 is not below its count 3");
    expect(spoilt("values", "byteOffset", 4), "do not fit");
    expect(spoilt("values", "bufferView", 99), "buffer view 99 is not there");
}

TEST_F(BadGltf, FilesOutsideOfTheFolderAreNotRead) {
    // A secret of the right length beside the asset's folder, so that a loader that follows the path would
    // succeed.
    const GltfFile triangle = GltfFile::triangle();
    folder_.write("secret.bin", triangle.binary);
    fs::create_directories(folder_.path() / "asset");
    fs::create_symlink("../secret.bin", folder_.path() / "asset" / "link.bin");
    fs::create_symlink("..", folder_.path() / "asset" / "up");
    const std::vector<std::pair<std::string, std::string>> uris{
        {"../secret.bin", "it leads out of the asset's folder"},
        {"%2e%2e%2fsecret.bin", "it leads out of the asset's folder"},
        {"sub/../../secret.bin", "it leads out of the asset's folder"},
        {"link.bin", "it leads out of the asset's folder"},
        {"up/secret.bin", "it leads out of the asset's folder"},
        {"../../../../../../../../etc/passwd", "it leads out of the asset's folder"},
        {"/etc/passwd", "an absolute path is not read"},
        {"%2fetc%2fpasswd", "an absolute path is not read"},
        {(folder_.path() / "secret.bin").string(), "an absolute path is not read"},
        {"file:///etc/passwd", "no scheme is"},
        {"http://example.org/x.bin", "no scheme is"},
        {"HTTP:x", "no scheme is"},
        {"..\\secret.bin", "backslash"},
        {"a%00b", "NUL"},
        {"a%zz", "two hexadecimal digits"},
        {"a%2", "two hexadecimal digits"},
        {".", "folder"},
        {"$(touch hacked).bin", ""},
        {"~/x.bin", ""},
    };
    for (const auto& [uri, reason] : uris) {
        SCOPED_TRACE(uri);
        GltfFile file = GltfFile::triangle();
        file.json["buffers"] =
            Json::array({{{"uri", uri}, {"byteLength", file.binary.size()}, {"name", "B"}}});
        const fs::path path = folder_.write("asset/scene.gltf", file.json.dump());
        expectError(path, "buffer 0 'B': uri '" + uri.substr(0, 60));
        expectError(path, reason);
        file.json.erase("buffers");
        file.json["images"] = Json::array({{{"uri", uri}, {"name", "I"}}});
        file.json["textures"] = Json::array({{{"source", 0}}});
        file.json["materials"] = Json::array({{{"emissiveTexture", {{"index", 0}}}}});
        file.primitive()["material"] = 0;
        expectError(folder_.write("asset/scene.glb", test::glb(file.withBuffer("").dump(), file.binary)),
                    reason);
    }
    EXPECT_FALSE(fs::exists(folder_.path() / "asset" / "hacked"));
    EXPECT_FALSE(fs::exists("hacked"));
}

TEST_F(BadGltf, PipesAndDevicesAreNotRead) {
    ASSERT_EQ(::mkfifo((folder_.path() / "pipe.bin").c_str(), 0600), 0);
    GltfFile file = GltfFile::triangle();
    file.json["buffers"] = Json::array({{{"uri", "pipe.bin"}, {"byteLength", file.binary.size()}}});
    expectError(folder_.write("scene.gltf", file.json.dump()), "pipe.bin");
}

TEST_F(BadGltf, BuffersThatAreNotThereOrTooShort) {
    GltfFile file = GltfFile::triangle();
    const auto expectBuffer = [&](const Json& buffer, const std::string& part) {
        file.json["buffers"] = Json::array({buffer});
        expectError(folder_.write("scene.gltf", file.json.dump()), part);
    };
    expectBuffer({{"uri", "missing.bin"}, {"byteLength", 36}}, "buffer 0: uri 'missing.bin'");
    expectBuffer({{"byteLength", 36}}, "neither a uri nor a binary chunk");
    expectBuffer({{"uri", "x"}}, "byteLength is missing");
    expectBuffer({{"uri", "x"}, {"byteLength", -1}}, "byteLength is missing");
    expectBuffer(3, "byteLength is missing");
    expectBuffer({{"uri", "data:application/octet-stream;base64,AAAA"}, {"byteLength", 36}},
                 "byteLength is 36, but only 3 bytes are there");
    expectBuffer({{"uri", "data:application/octet-stream;base64,AAAA"}, {"byteLength", UINT64_MAX}},
                 "but only 3 bytes are there");
    expectBuffer({{"uri", "data:application/octet-stream;base64,A*AA"}, {"byteLength", 3}},
                 "the base64 text is damaged");
    expectBuffer({{"uri", "data:application/octet-stream;base64,AAAAA"}, {"byteLength", 3}},
                 "the base64 text is damaged");
    expectBuffer({{"uri", "data:application/octet-stream;base64,A==="}, {"byteLength", 1}},
                 "the base64 text is damaged");
    expectBuffer({{"uri", "data:text/plain,hello"}, {"byteLength", 5}}, "not base64");
    expectBuffer({{"uri", "data:x;base64," + std::string(100000, '!')}, {"byteLength", 36}},
                 "the base64 text is damaged");
}

TEST_F(BadGltf, ImagesThatAreNotThereOrNoPictures) {
    GltfFile file = GltfFile::triangle();
    file.primitive()["material"] = 0;
    file.json["textures"] = Json::array({{{"source", 0}}});
    file.json["materials"] = Json::array({{{"name", "A"}, {"emissiveTexture", {{"index", 0}}}}});
    const auto expectImage = [&](const Json& image, const std::string& part) {
        file.json["images"] = Json::array({image});
        expect(file, part);
    };
    expectImage({{"uri", "missing.png"}, {"name", "I"}}, "image 0 'I': uri 'missing.png'");
    folder_.write("noise.png", "no picture");
    expectImage({{"uri", "noise.png"}, {"name", "I"}}, "image 0 'I'");
    expectImage({{"bufferView", 0}}, "image 0");
    expectImage({{"bufferView", 44}}, "buffer view 44 is not there");
    expectImage(Json::object(), "buffer view -1 is not there");
    expectImage("text", "buffer view -1 is not there");
    file.json["textures"][0]["source"] = 5;
    expect(file, "material 0 'A': image 5 is not there");
    file.json["textures"] = Json::array();
    expect(file, "material 0 'A': texture 0 is not there");
    file.json["materials"] = Json::array();
    expect(file, "material 0 is not there");
}

TEST_F(BadGltf, NodesThatFormNoTree) {
    const std::vector<std::pair<Json, std::string>> trees{
        {Json::array({{{"children", {0}}}}), "node 0: it belongs to a cycle"},
        {Json::array({{{"children", {1}}, {"name", "a"}}, {{"children", {0}}}}),
         "node 0 'a': it belongs to a cycle"},
        {Json::array({{{"children", {2}}}, {{"children", {2}}}, Json::object()}),
         "node 2: it has two parents, nodes 0 and 1"},
        {Json::array({{{"children", {1, 1}}}, Json::object()}), "node 1: it has two parents, nodes 0 and 0"},
        {Json::array({{{"children", {7}}}}), "node 0: child node 7 is not there"},
        {Json::array({{{"children", {-1}}}}), "node 0: child node -1 is not there"},
        {Json::array({{{"mesh", 3}}}), "node 0: mesh 3 is not there"},
        {Json::array({{{"camera", 3}}}), "node 0: camera 3 is not there"},
        {Json::array({{{"mesh", 0}, {"skin", 3}}}), "skin 3 is not there"},
        {Json::array({{{"matrix", {1, 0, 0}}}}), "node 0: its matrix has 3 numbers, 16 are wanted"},
        {Json::array({{{"scale", {1, 0}}}}), "node 0: its scale has 2 numbers, 3 are wanted"},
    };
    for (const auto& [nodes, part] : trees) {
        GltfFile file = GltfFile::triangle();
        file.json["nodes"] = nodes;
        file.json.erase("scenes");
        file.primitive()["attributes"]["JOINTS_0"] =
            file.accessor<std::uint8_t>(std::vector<std::uint8_t>(12), test::kUnsignedByte, "VEC4", 3);
        file.primitive()["attributes"]["WEIGHTS_0"] = file.vec4s(std::vector<float>(12, 0.25F));
        SCOPED_TRACE(nodes.dump());
        expect(file, part);
    }
    GltfFile file = GltfFile::triangle();
    file.json["scenes"][0]["nodes"] = {0, 0};
    expect(file, "scene 0: node 0 is listed twice");
    file.json["scenes"][0]["nodes"] = {4};
    expect(file, "scene 0: node 4 is not there");
    file.json["nodes"].push_back({{"children", {0}}});
    file.json["scenes"][0]["nodes"] = {0};
    expect(file, "scene 0: node 0 is no root, its parent is node 1");
    file.json["scene"] = 8;
    expect(file, "the default scene: scene 8 is not there");
    EXPECT_NE(errorOf(file.writeGlb(folder_), 5).find("the scene asked for: scene 5 is not there"),
              std::string::npos);
}

TEST_F(BadGltf, JointsThatAreNotThere) {
    GltfFile file = GltfFile::triangle();
    file.primitive()["attributes"]["JOINTS_0"] =
        file.accessor<std::uint8_t>(std::vector<std::uint8_t>(12, 1), test::kUnsignedByte, "VEC4", 3);
    file.primitive()["attributes"]["WEIGHTS_0"] = file.vec4s(std::vector<float>(12, 0.25F));
    file.json["nodes"][0]["skin"] = 0;
    file.json["skins"] = Json::array({{{"joints", {0}}}});
    expect(file, "vertex 0 names joint 1, the skin has 1");
    file.json["skins"] = Json::array({{{"joints", {9}}}});
    expect(file, "joint node 9 is not there");
    file.json["skins"] = Json::array({{{"joints", Json::array()}}});
    expect(file, "skin 0: it has no joints");
}

TEST_F(BadGltf, RequiredExtensionsThatAreUnknown) {
    for (const char* extension : {"KHR_draco_mesh_compression", "KHR_texture_basisu", "VENDOR_new"}) {
        GltfFile file = GltfFile::triangle();
        file.json["extensionsRequired"] = {extension};
        // Where a buffer is missing as well, the extension is the reason that helps.
        file.json["buffers"] = Json::array({{{"byteLength", 36}}});
        const fs::path path = folder_.write("scene.gltf", file.json.dump());
        EXPECT_EQ(errorOf(path), path.string() + ": required extension '" + extension + "' is not supported");
    }
}

}  // namespace
}  // namespace licht
