#include "licht/scene/instancing.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "licht/scene/effects.h"
#include "licht/shared/effects.h"

namespace licht {
namespace {

/// `uses` instances in a row of a strip with that many triangles.
Scene row(std::uint64_t triangles, std::uint64_t uses) {
    Scene scene;
    Material matte;
    matte.metallic = 0.0F;
    matte.specular = 0.0F;
    scene.materials.push_back(matte);
    Mesh mesh;
    mesh.name = "Leaf";
    for (std::uint32_t i = 0; i < triangles + 2; ++i) {
        mesh.positions.emplace_back(static_cast<float>(i / 2), static_cast<float>(i % 2), 0.0F);
    }
    for (std::uint32_t i = 0; i < triangles; ++i) {
        mesh.triangles.emplace_back(i, i + 1, i + 2);
    }
    scene.meshes.push_back(mesh);
    for (std::uint64_t i = 0; i < uses; ++i) {
        scene.instances.push_back({"Leaf", 0, glm::translate(mat4(1.0F), vec3(0, 0, static_cast<float>(i)))});
    }
    return scene;
}

constexpr std::uint64_t kTriangles = 64;
constexpr std::uint64_t kEnough = kLeastSavedByScene / kTriangles + 1;

TEST(Instancing, ManyUsesOfOneMeshShareIt) {
    const Instancing chosen = chooseInstanced(row(kTriangles, kEnough));
    EXPECT_EQ(chosen.count, kEnough);
    EXPECT_EQ(chosen.most_used, 0U);
    EXPECT_EQ(chosen.most_uses, kEnough);
    EXPECT_TRUE(
        std::all_of(chosen.instanced.begin(), chosen.instanced.end(), [](std::uint8_t b) { return b == 1; }));
}

TEST(Instancing, AFewUsesAreBaked) {
    const Instancing chosen = chooseInstanced(row(kTriangles, kEnough - 1));
    EXPECT_EQ(chosen.count, 0U);
    EXPECT_EQ(chosen.most_used, kNone);
    EXPECT_EQ(chosen.instanced.size(), kEnough - 1);
    EXPECT_EQ(chooseInstanced(row(2 * kLeastSavedByScene, 1)).count, 0U);
    EXPECT_EQ(chooseInstanced(Scene{}).count, 0U);
}

TEST(Instancing, TinyMeshesAreBaked) {
    EXPECT_EQ(chooseInstanced(row(kLeastInstancedTriangles - 1, kLeastSavedByScene)).count, 0U);
    EXPECT_EQ(chooseInstanced(row(kLeastInstancedTriangles, kLeastSavedByScene)).count, kLeastSavedByScene);
}

TEST(Instancing, MeshesThatSaveLittleAreBakedBesideOthers) {
    Scene scene = row(kTriangles, kEnough);
    scene.meshes.push_back(scene.meshes[0]);
    for (std::uint64_t i = 0; i < kLeastSavedByMesh / kTriangles; ++i) {
        scene.instances.push_back({"few", 1, mat4(1.0F)});
    }
    EXPECT_EQ(chooseInstanced(scene).count, kEnough);
    scene.instances.push_back({"one more", 1, mat4(1.0F)});
    EXPECT_EQ(chooseInstanced(scene).count, scene.instances.size());
}

TEST(Instancing, EmissiveMeshesAreBaked) {
    Scene scene = row(kTriangles, kEnough);
    scene.materials[0].emission = vec3(0, 0, 1);
    EXPECT_EQ(chooseInstanced(scene).count, 0U);
    scene.materials[0].unlit = true;  // shows its colour instead
    EXPECT_EQ(chooseInstanced(scene).count, kEnough);
}

TEST(Instancing, TransformsThatCannotBeUndoneAreBaked) {
    Scene scene = row(kTriangles, kEnough);
    scene.instances[3].world_from_object = glm::scale(mat4(1.0F), vec3(1, 0, 1));
    scene.instances[5].world_from_object = glm::scale(mat4(1.0F), vec3(-1, 1, 1));
    const Instancing chosen = chooseInstanced(scene);
    EXPECT_EQ(chosen.count, kEnough - 1);
    EXPECT_EQ(chosen.instanced[3], 0);
    EXPECT_EQ(chosen.instanced[5], 1);
}

TEST(Instancing, IsAnEffectWithItsEvidence) {
    const Effects effects = detectEffects(row(kTriangles, kEnough));
    EXPECT_TRUE(effects.has(kEffectInstances));
    EXPECT_EQ(effects.evidence[kEffectInstances],
              "mesh 'Leaf' is used " + std::to_string(kEnough) + " times");
    EXPECT_FALSE(detectEffects(row(kTriangles, 2)).has(kEffectInstances));
}

TEST(Instancing, MeshesAreCentredOnTheirTriangles) {
    Mesh mesh = row(2, 1).meshes[0];
    mesh.positions.emplace_back(1000.0F, 0.0F, 0.0F);  // in no triangle
    EXPECT_EQ(meshCentre(mesh), vec3(0.5F, 0.5F, 0.0F));
    EXPECT_EQ(meshCentre(Mesh{}), vec3(0.0F));
}

}  // namespace
}  // namespace licht
