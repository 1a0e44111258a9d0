// EXT_mesh_gpu_instancing, from files that the test writes.
#include <gtest/gtest.h>

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

/// A triangle whose node carries the extension with these attributes.
GltfFile crowd(const std::function<Json(GltfFile&)>& attributes) {
    GltfFile file = GltfFile::triangle();
    const Json made = attributes(file);
    file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = made;
    file.json["extensionsUsed"] = Json::array({"EXT_mesh_gpu_instancing"});
    return file;
}

Scene load(const GltfFile& file) {
    const TemporaryFolder folder;
    return loadGltf(file.writeGlb(folder));
}

std::string errorOf(const GltfFile& file) {
    try {
        load(file);
    } catch (const InputError& e) {
        return e.what();
    }
    return "no error";
}

void expectNear(const mat4& m, const mat4& wanted, float tolerance) {
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            EXPECT_NEAR(m[column][row], wanted[column][row], tolerance) << column << ", " << row;
        }
    }
}

// One rounding to float of what is exact in double.
constexpr float kRounding = 1e-6F;

TEST(GltfInstancing, PlacesTheMeshOncePerElement) {
    GltfFile file = crowd([](GltfFile& f) {
        return Json{
            {"TRANSLATION", f.vec3s({1, 2, 3, -4, 5, 6})},
            {"ROTATION", f.vec4s({0, 0, 0, 1, 0, 0, 2, 2})},  // the second of length sqrt(8): normalised
            {"SCALE", f.vec3s({1, 1, 1, 2, 3, -1})}};
    });
    file.json["nodes"][0]["translation"] = {10, 0, 0};
    const Scene scene = load(file);
    ASSERT_EQ(scene.meshes.size(), 1U);
    ASSERT_EQ(scene.instances.size(), 2U);
    EXPECT_TRUE(scene.notes.empty());
    EXPECT_EQ(scene.instances[0].name, "N");
    expectNear(scene.instances[0].world_from_object, glm::translate(mat4(1.0F), vec3(11, 2, 3)), 0.0F);
    // A quarter turn about z: x goes to y, y to -x.
    expectNear(scene.instances[1].world_from_object,
               mat4(vec4(0, 2, 0, 0), vec4(-3, 0, 0, 0), vec4(0, 0, -1, 0), vec4(6, 5, 6, 1)), kRounding);
}

TEST(GltfInstancing, OneAttributeIsEnough) {
    EXPECT_EQ(load(crowd([](GltfFile& f) {
                  return Json{{"SCALE", f.vec3s({1, 1, 1, 2, 2, 2, 3, 3, 3})}};
              })).instances.size(),
              3U);
}

TEST(GltfInstancing, RotationsMayBeNormalisedIntegers) {
    const auto turned = [](auto values, int type) {
        const Scene scene = load(crowd([&](GltfFile& f) {
            return Json{{"ROTATION", f.accessor(values, type, "VEC4", values.size() / 4, true)}};
        }));
        return scene.instances.at(0).world_from_object;
    };
    // Half a turn about x, exactly, in both types.
    const mat4 wanted(vec4(1, 0, 0, 0), vec4(0, -1, 0, 0), vec4(0, 0, -1, 0), vec4(0, 0, 0, 1));
    expectNear(turned(std::vector<std::int8_t>{127, 0, 0, 0}, test::kByte), wanted, kRounding);
    expectNear(turned(std::vector<std::int16_t>{32767, 0, 0, 0}, test::kShort), wanted, kRounding);
}

TEST(GltfInstancing, EveryPrimitiveIsPlaced) {
    GltfFile file = crowd([](GltfFile& f) {
        return Json{{"TRANSLATION", f.vec3s({0, 0, 0, 1, 0, 0, 2, 0, 0})}};
    });
    file.json["meshes"][0]["primitives"].push_back(file.primitive());
    const Scene scene = load(file);
    EXPECT_EQ(scene.meshes.size(), 2U);
    EXPECT_EQ(scene.instances.size(), 6U);
}

TEST(GltfInstancing, CustomAttributesAreNoMatter) {
    const Scene scene = load(crowd([](GltfFile& f) {
        return Json{{"TRANSLATION", f.vec3s({0, 0, 0})}, {"_ID", f.indices({1, 2, 3})}};
    }));
    EXPECT_EQ(scene.instances.size(), 1U);
}

TEST(GltfInstancing, FlattenedInstancesAreLeftOutWithOneNote) {
    const Scene scene = load(crowd([](GltfFile& f) {
        return Json{{"SCALE", f.vec3s({1, 1, 1, 0, 1, 1, 1, 1, 1, 1, 1, 0})}};
    }));
    EXPECT_EQ(scene.instances.size(), 2U);
    ASSERT_EQ(scene.notes.size(), 1U);
    EXPECT_EQ(scene.notes[0].kind, SceneNote::Kind::skipped);
    EXPECT_NE(scene.notes[0].text.find("node 0 'N': 2 of its 4 instances: its transform flattens it"),
              std::string::npos)
        << scene.notes[0].text;
}

TEST(GltfInstancing, NoInstancesShowNothing) {
    GltfFile file = crowd([](GltfFile& f) { return Json{{"TRANSLATION", f.vec3s({0, 0, 0})}}; });
    file.json["accessors"].back()["count"] = 0;
    EXPECT_TRUE(load(file).instances.empty());
}

TEST(GltfInstancing, MayBeRequired) {
    GltfFile file = crowd([](GltfFile& f) { return Json{{"TRANSLATION", f.vec3s({0, 0, 0})}}; });
    file.json["extensionsRequired"] = Json::array({"EXT_mesh_gpu_instancing"});
    EXPECT_EQ(load(file).instances.size(), 1U);
}

TEST(GltfInstancing, DamageIsNamed) {
    struct Case {
        const char* what;
        std::function<Json(GltfFile&)> attributes;
        const char* message;
    };
    const std::vector<Case> cases{
        {"lengths differ",
         [](GltfFile& f) {
             return Json{{"TRANSLATION", f.vec3s({0, 0, 0, 1, 1, 1})}, {"SCALE", f.vec3s({1, 1, 1})}};
         },
         "node 0 'N': EXT_mesh_gpu_instancing SCALE: it has 1 elements, the attribute before it 2"},
        {"no accessor",
         [](GltfFile&) {
             return Json{{"SCALE", 99}};
         },
         "SCALE: accessor 99 is not there"},
        {"no index",
         [](GltfFile&) {
             return Json{{"SCALE", "big"}};
         },
         "it is no index of an accessor"},
        {"wrong shape",
         [](GltfFile& f) {
             return Json{{"ROTATION", f.vec3s({0, 0, 0})}};
         },
         "it has 3 components, 4 are wanted"},
        {"plain integers",
         [](GltfFile& f) {
             return Json{
                 {"ROTATION", f.accessor(std::vector<std::int16_t>{0, 0, 0, 1}, test::kShort, "VEC4", 1)}};
         },
         "neither floats nor normalised bytes or shorts"},
        {"translation in integers",
         [](GltfFile& f) {
             return Json{{"TRANSLATION",
                          f.accessor(std::vector<std::int16_t>{0, 0, 0, 0}, test::kShort, "VEC3", 1, true)}};
         },
         "TRANSLATION: its components are not floats"},
        {"nothing of use",
         [](GltfFile& f) {
             return Json{{"_ID", f.indices({1})}};
         },
         "none of TRANSLATION, ROTATION and SCALE"},
        {"no object", [](GltfFile&) { return Json(3); }, "EXT_mesh_gpu_instancing has no attributes"},
    };
    for (const Case& c : cases) {
        const std::string error = errorOf(crowd(c.attributes));
        EXPECT_NE(error.find(c.message), std::string::npos) << c.what << ": " << error;
    }
}

TEST(GltfInstancing, OddRotationsAreTakenAsNone) {
    const Scene scene = load(crowd([](GltfFile& f) { return Json{{"ROTATION", f.vec4s({0, 0, 0, 0})}}; }));
    ASSERT_EQ(scene.instances.size(), 1U);
    expectNear(scene.instances[0].world_from_object, mat4(1.0F), 0.0F);
    ASSERT_EQ(scene.notes.size(), 1U);
    EXPECT_EQ(scene.notes[0].kind, SceneNote::Kind::warning);
}

}  // namespace
}  // namespace licht
