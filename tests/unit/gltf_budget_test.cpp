// What a small file stands for is summed up before any of it is made.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <string>

#include "../support/gltf_file.h"
#include "licht/core/error.h"
#include "licht/core/file.h"
#include "licht/core/memory.h"
#include "licht/image/files.h"
#include "licht/scene/gltf.h"

namespace licht {
namespace {

using test::GltfFile;
using test::Json;

class GltfBudget : public testing::Test {
protected:
    void TearDown() override { limitMemory(limit_before_); }

    std::string refusal(const GltfFile& file, bool strict = false) const {
        try {
            loadGltf(file.writeGlb(folder_), {.strict = strict});
        } catch (const InputError& error) {
            return error.what();
        }
        return {};
    }
    void expectRefusal(const GltfFile& file, const std::string& part) const {
        const std::string text = refusal(file);
        EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in: " << text;
    }

    /// A PNG of one colour.
    std::string picture(float grey, int side = 2) const {
        Image image(side, side, 3);
        std::fill(image.texels.begin(), image.texels.end(), grey);
        const std::filesystem::path path = folder_.path() / "made.png";
        writePng(path, image);
        const std::vector<std::byte> bytes = readFile(path);
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }

    test::TemporaryFolder folder_;

private:
    std::uint64_t limit_before_ = memoryLimit();
};

/// An accessor without bytes; its index.
int implied(GltfFile& file, std::uint64_t count, const char* type = "VEC3") {
    file.json["accessors"].push_back({{"componentType", 5126}, {"count", count}, {"type", type}});
    return static_cast<int>(file.json["accessors"].size()) - 1;
}

TEST_F(GltfBudget, AccessorsWithoutBytesAreBelievedInSum) {
    // Each alone would be: 2^23 + 2^23 + 1 elements.
    GltfFile file = GltfFile::triangle();
    file.primitive()["attributes"]["POSITION"] = implied(file, 1U << 23U);
    file.primitive()["attributes"]["NORMAL"] = implied(file, (1U << 23U) + 1);
    expectRefusal(file, "stand for 16777217 elements in all");

    GltfFile morphed = GltfFile::triangle();
    const int deltas = implied(morphed, 1U << 23U);
    morphed.primitive()["targets"] =
        Json::array({{{"POSITION", deltas}}, {{"POSITION", deltas}}, {{"POSITION", deltas}}});
    morphed.json["meshes"][0]["weights"] = {1, 0, 1};
    expectRefusal(morphed, "POSITION has");  // two of them count, and then their length is wrong
    morphed.json["meshes"][0]["weights"] = {1, 1, 1};
    expectRefusal(morphed, "stand for 25165824 elements in all");

    GltfFile skinned = GltfFile::triangle();
    skinned.json["skins"] =
        Json::array({{{"joints", {0}}, {"inverseBindMatrices", implied(skinned, (1U << 24U) + 1, "MAT4")}}});
    skinned.json["nodes"][0]["skin"] = 0;
    expectRefusal(skinned, "stand for 16777217 elements in all");
}

TEST_F(GltfBudget, InstancesAreCountedOverAllNodes) {
    GltfFile file = GltfFile::triangle();
    const Json placed{
        {"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", implied(file, 1U << 19U)}}}}}};
    file.json["nodes"][0]["extensions"] = placed;
    file.json["nodes"].push_back({{"mesh", 0}, {"extensions", placed}});
    file.json["nodes"].push_back({{"mesh", 0}, {"extensions", placed}});
    file.json["scenes"][0]["nodes"] = {0, 1, 2};
    expectRefusal(file, "place 1572864 instances in all");
    // What is not shown costs nothing.
    file.json["scenes"][0]["nodes"] = Json::array({0});
    EXPECT_EQ(refusal(file), "");
}

TEST_F(GltfBudget, CopiesOfSkinnedMeshesCountEach) {
    limitMemory(memoryInUse() + (std::uint64_t{256} << 20U));
    GltfFile file = GltfFile::triangle();
    std::string zeros(12 * 200'000, '\0');
    file.json["accessors"].push_back(
        {{"bufferView", file.view(zeros)}, {"componentType", 5126}, {"count", 200'000}, {"type", "VEC3"}});
    file.primitive()["attributes"]["POSITION"] = static_cast<int>(file.json["accessors"].size()) - 1;
    file.json["skins"] = Json::array({{{"joints", {0}}}});
    for (int i = 1; i < 40; ++i) {
        file.json["nodes"].push_back({{"mesh", 0}});
        file.json["scenes"][0]["nodes"].push_back(i);
    }
    EXPECT_EQ(refusal(file), "");  // forty nodes, one mesh
    for (int i = 1; i < 40; ++i) file.json["nodes"][static_cast<std::size_t>(i)]["skin"] = 0;
    expectRefusal(file, "of memory beside");
    expectRefusal(file, "most of it mesh 0 'M' primitive 0: 200000 vertices");
}

TEST_F(GltfBudget, MoreMeshesThanCanBeTracedAreNotPlaced) {
    GltfFile file = GltfFile::triangle();
    const Json primitive = file.primitive();
    for (int i = 1; i < 17; ++i) file.json["meshes"][0]["primitives"].push_back(primitive);
    file.json["nodes"][0]["extensions"] = {
        {"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", implied(file, 1U << 20U)}}}}}};
    expectRefusal(file, "the scene places 17825792 meshes, and at most 16777216 can be traced");
}

GltfFile withImages(const std::vector<Json>& images) {
    GltfFile file = GltfFile::triangle();
    file.primitive()["attributes"]["TEXCOORD_0"] = file.vec2s({0, 0, 1, 0, 0, 1});
    file.json["images"] = images;
    const Json primitive = file.primitive();
    file.json["meshes"][0]["primitives"] = Json::array();
    for (std::size_t i = 0; i < images.size(); ++i) {
        file.json["textures"].push_back({{"source", i}});
        file.json["materials"].push_back({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", i}}}}},
                                          {"normalTexture", {{"index", i}}}});
        Json one = primitive;
        one["material"] = i;
        file.json["meshes"][0]["primitives"].push_back(one);
    }
    return file;
}

TEST_F(GltfBudget, TheSameImageIsDecodedOnce) {
    const std::string white = picture(1.0F);
    const std::string grey = picture(0.5F);
    const std::string as_data = "data:image/png;base64,";
    // By one name twice, and by another.
    folder_.write("white.png", white);
    const GltfFile file = withImages({{{"uri", as_data + test::base64(white)}, {"name", "a"}},
                                      {{"uri", as_data + test::base64(grey)}, {"name", "b"}},
                                      {{"uri", as_data + test::base64(white)}, {"name", "c"}},
                                      {{"uri", "white.png"}, {"name", "d"}}});
    const Scene scene = loadGltf(file.writeGlb(folder_));
    ASSERT_EQ(scene.textures.size(), 2U);
    EXPECT_EQ(scene.textures[0].bytes[0], 255);
    EXPECT_EQ(scene.textures[1].bytes[0], 128);
    ASSERT_EQ(scene.materials.size(), 4U);
    EXPECT_EQ(scene.materials[3].slots[kSlotBaseColor].texture, 0U);
    EXPECT_EQ(scene.materials[0].slots[kSlotBaseColor].texture, 0U);
    EXPECT_EQ(scene.materials[1].slots[kSlotBaseColor].texture, 1U);
    EXPECT_EQ(scene.materials[2].slots[kSlotBaseColor].texture, 0U);
}

TEST_F(GltfBudget, ImagesAreSummedUpBeforeAnyIsDecoded) {
    std::vector<Json> images;
    for (int i = 0; i < 3; ++i)
        images.push_back(
            {{"uri", "data:image/png;base64," + test::base64(picture(0.1F * static_cast<float>(i), 2048))}});
    // Each takes 16 MiB, decoded.
    limitMemory(memoryInUse() + (std::uint64_t{40} << 20U));
    expectRefusal(withImages(images), "the 3 images of its textures take, decoded, about 48 MiB of memory");
}

TEST_F(GltfBudget, ImagesThatCannotBeReadHaveAStandIn) {
    const std::string whole = picture(0.5F, 64);
    for (const Json& image :
         {Json{{"uri", "gone.png"}}, Json{{"uri", "data:image/png;base64,AAAA"}}, Json{{"bufferView", 99}},
          Json{{"uri", "../outside.png"}},
          Json{{"uri", "data:image/png;base64," + test::base64(whole.substr(0, whole.size() / 2))}}}) {
        SCOPED_TRACE(image.dump().substr(0, 80));
        const GltfFile file = withImages({image});
        EXPECT_NE(refusal(file, true).find("image 0"), std::string::npos);
        const Scene scene = loadGltf(file.writeGlb(folder_));
        const auto said = std::find_if(scene.notes.begin(), scene.notes.end(), [](const SceneNote& note) {
            return note.kind == SceneNote::Kind::warning && note.text.find("image 0") != std::string::npos;
        });
        EXPECT_NE(said, scene.notes.end());
        // Colours show it, normals do not follow it.
        ASSERT_EQ(scene.textures.size(), 1U);
        const Texture& texture = scene.textures[0];
        ASSERT_EQ(texture.bytes.size(), std::size_t{4} * texture.width * texture.height);
        EXPECT_EQ(std::vector<std::uint8_t>(texture.bytes.begin(), texture.bytes.begin() + 8),
                  (std::vector<std::uint8_t>{255, 0, 255, 255, 0, 0, 0, 255}));
        EXPECT_TRUE(scene.materials.at(0).slots[kSlotBaseColor].present());
        EXPECT_FALSE(scene.materials.at(0).slots[kSlotBaseColor].linear);
        EXPECT_FALSE(scene.materials.at(0).slots[kSlotNormal].present());
    }
}

}  // namespace
}  // namespace licht
