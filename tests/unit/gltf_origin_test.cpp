// Scenes far from the world's origin: what nodes say is moved there, what vertices say is warned of.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "../support/gltf_file.h"
#include "licht/scene/gltf.h"

namespace licht {
namespace {

using test::GltfFile;
using test::Json;

class GltfOrigin : public testing::Test {
protected:
    Scene load(const GltfFile& file) const { return loadGltf(file.writeGlb(folder_)); }

private:
    test::TemporaryFolder folder_;
};

bool isCoarse(const Scene& scene) {
    return std::ranges::any_of(scene.notes, [](const SceneNote& note) {
        return note.kind == SceneNote::Kind::warning && note.text.find("coarse") != std::string::npos;
    });
}

/// Two triangles of 1 m, 3 m from each other, a camera and a lamp, all below one node that stands at `at`;
/// corners of the triangles begin at `corner`.
GltfFile pair(const std::vector<double>& at, float corner = 0.0F) {
    GltfFile file = GltfFile::triangle();
    const float far = corner + 1.0F;
    const int positions = file.vec3s({corner, corner, corner, far, corner, corner, corner, far, corner});
    file.json["accessors"][static_cast<std::size_t>(positions)]["min"] = {corner, corner, corner};
    file.json["accessors"][static_cast<std::size_t>(positions)]["max"] = {far, far, corner};
    file.primitive()["attributes"]["POSITION"] = positions;
    file.json["cameras"] =
        Json::array({{{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}}});
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({{{"type", "point"}}});
    file.json["nodes"] = Json::array(
        {{{"translation", at}, {"children", {1, 2, 3, 4}}},
         {{"mesh", 0}},
         {{"mesh", 0}, {"translation", {3, 0, 0.5}}},
         {{"camera", 0}, {"translation", {1, 2, 7.25}}},
         {{"translation", {0.125, 4, 0}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}}});
    file.json["scenes"][0]["nodes"] = Json::array({0});
    return file;
}

TEST_F(GltfOrigin, StaysWhereNothingIsFar) {
    for (const std::vector<double>& at : {std::vector<double>{0, 0, 0}, {5, 0, -2}, {0, 12, 0}}) {
        const Scene scene = load(pair(at));
        EXPECT_EQ(scene.origin, glm::dvec3(0.0));
        EXPECT_EQ(vec3(scene.instances.at(0).world_from_object[3]), vec3(at[0], at[1], at[2]));
        EXPECT_FALSE(isCoarse(scene));
    }
}

// Everything keeps its place to the others to the last bit, although floats there have steps of half a metre.
TEST_F(GltfOrigin, FollowsWhatNodesPlaceFarAway) {
    const std::vector<double> at{6378137.25, -4194304.0, 8e6};
    const Scene scene = load(pair(at));
    const glm::dvec3 origin = scene.origin;
    EXPECT_LT(glm::length(origin - glm::dvec3(at[0], at[1], at[2])), 8.0);
    const auto expectPlace = [&](const vec3& place, const glm::dvec3& local) {
        EXPECT_EQ(place, vec3(glm::dvec3(at[0], at[1], at[2]) - origin + local));
    };
    ASSERT_EQ(scene.instances.size(), 2U);
    expectPlace(vec3(scene.instances[0].world_from_object[3]), {0, 0, 0});
    expectPlace(vec3(scene.instances[1].world_from_object[3]), {3, 0, 0.5});
    expectPlace(vec3(scene.cameras.at(0).world_from_view[3]), {1, 2, 7.25});
    expectPlace(scene.lights.at(0).position, {0.125, 4, 0});
    EXPECT_FALSE(isCoarse(scene));
}

TEST_F(GltfOrigin, WarnsOfVerticesThatAreFarFromTheirOwn) {
    EXPECT_FALSE(isCoarse(load(pair({0, 0, 0}, 1000.0F))));
    const Scene scene = load(pair({0, 0, 0}, 1e6F));
    EXPECT_TRUE(isCoarse(scene));
    // They come to the origin nevertheless: rays are traced where floats are dense.
    EXPECT_LT(
        static_cast<double>(glm::length(vec3(scene.instances[0].world_from_object * vec4(vec3(1e6F), 1.0F)))),
        8.0);
}

TEST_F(GltfOrigin, WarnsOfSmallThingsInAWideScene) {
    GltfFile file = pair({0, 0, 0});
    file.json["nodes"][1]["translation"] = {-1e6, 0, 0};
    file.json["nodes"][2]["translation"] = {1e6, 0, 0};
    const Scene scene = load(file);
    EXPECT_EQ(scene.origin, glm::dvec3(0.0));
    EXPECT_TRUE(isCoarse(scene));
}

TEST_F(GltfOrigin, BelievesNoBoundsThatLie) {
    GltfFile file = pair({0, 0, 0});
    const auto positions = file.primitive()["attributes"]["POSITION"].get<std::size_t>();
    file.json["accessors"][positions]["min"] = {1e8, 1e8, 1e8};
    file.json["accessors"][positions]["max"] = {1e8 + 1, 1e8 + 1, 1e8 + 1};
    const Scene scene = load(file);
    EXPECT_EQ(scene.origin, glm::dvec3(0.0));
    ASSERT_EQ(scene.instances.size(), 2U);
    EXPECT_EQ(vec3(scene.instances[1].world_from_object[3]), vec3(3, 0, 0.5F));
    EXPECT_EQ(scene.meshes.size(), 1U);
}

// Bounds of normalised numbers are stated as they are stored.
TEST_F(GltfOrigin, ReadsBoundsOfNormalisedNumbers) {
    GltfFile file = pair({1e6, 0, 0});
    const int positions = file.accessor(std::vector<std::int16_t>{0, 0, 0, 32767, 0, 0, 0, 32767, 0},
                                        test::kShort, "VEC3", 3, true);
    file.json["accessors"][static_cast<std::size_t>(positions)]["min"] = {0, 0, 0};
    file.json["accessors"][static_cast<std::size_t>(positions)]["max"] = {32767, 32767, 0};
    file.primitive()["attributes"]["POSITION"] = positions;
    file.json["extensionsUsed"] = {"KHR_mesh_quantization"};
    EXPECT_NEAR(load(file).origin.x, 1e6, 8.0);
}

TEST_F(GltfOrigin, FollowsJointsOfSkins) {
    GltfFile file = pair({1e6, 0, 0});
    file.json["skins"] = Json::array({{{"joints", {1}}}});
    file.json["nodes"][1]["skin"] = 0;
    file.json["nodes"][2].erase("mesh");
    const int joints = file.accessor(std::vector<std::uint8_t>(12, 0), test::kUnsignedByte, "VEC4", 3);
    file.primitive()["attributes"]["JOINTS_0"] = joints;
    file.primitive()["attributes"]["WEIGHTS_0"] = file.vec4s({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    const Scene scene = load(file);
    EXPECT_EQ(scene.origin, glm::dvec3(1e6, 0.0, 0.0));
    EXPECT_EQ(scene.meshes.at(0).positions, (std::vector<vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
}

}  // namespace
}  // namespace licht
