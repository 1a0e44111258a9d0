// What a scene takes on the device is known beforehand, and very many instances are drawn at once.
#include "licht/on_device/scene_size.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "licht/bvh/instances.h"
#include "licht/core/error.h"
#include "licht/core/memory.h"
#include "licht/on_device/gpu_scene.h"
#include "licht/render/renderer.h"
#include "licht/scene/instancing.h"
#include "licht/shared/bvh_layout.h"
#include "licht/shared/effects.h"
#include "samples/scenes/shapes.h"
#include "support/gpu_test.h"
#include "support/render_test.h"

namespace licht {
namespace {

std::string refusal(const std::function<void()>& work) {
    try {
        work();
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

std::string refusal(const SceneSize& size) {
    return refusal([&] { requireRoom(gpu::testDevice(), size, Effects{}); });
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// A grid of quads that face +Z, `columns` a side and of two materials in turn: an instance each, or one of
/// all quads of a material.
Scene quads(int columns, bool apart) {
    Scene scene;
    scene.materials = {lambert(0.25F), lambert(0.5F)};
    scene.meshes.resize(2);
    const auto add = [](Mesh& mesh, const vec3& at) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const vec3& corner :
             {vec3(0, 0, 0), vec3(0.75F, 0, 0), vec3(0.75F, 0.75F, 0), vec3(0, 0.75F, 0)})
            mesh.positions.push_back(at + corner);
        mesh.triangles.push_back(uvec3(first, first + 1, first + 2));
        mesh.triangles.push_back(uvec3(first, first + 2, first + 3));
    };
    for (std::uint32_t k = 0; k < 2; ++k) {
        scene.meshes[k].material = k;
        if (apart) add(scene.meshes[k], vec3(0.0F));
        if (!apart) scene.instances.push_back({"all", k, mat4(1.0F)});
    }
    for (int i = 0; i < columns * columns; ++i) {
        const auto material = static_cast<std::uint32_t>(i % columns + i / columns) % 2U;
        const vec3 at(static_cast<float>(i % columns), static_cast<float>(i / columns), 0.0F);
        if (apart)
            scene.instances.push_back({"quad", material, glm::translate(mat4(1.0F), at)});
        else
            add(scene.meshes[material], at);
    }
    scene.environment = constantEnvironment(vec3(1.0F));
    return scene;
}

TEST(SceneSize, CountsBakedOnesEachAndInstancedMeshesOnce) {
    Scene scene = quads(7, true);
    for (Instance& instance : scene.instances) instance.mesh = 0;
    InstanceOrder order = orderInstances(scene, Effects{});
    SceneSize size = sizeOnDevice(scene, order);
    EXPECT_EQ(size.vertices, 4U * 49);
    EXPECT_EQ(size.baked_triangles, 2U * 49);
    EXPECT_EQ(size.mesh_triangles, 0U);
    EXPECT_EQ(size.placements, 0U);
    order.baked = 9;  // as if forty of them shared their mesh
    size = sizeOnDevice(scene, order);
    EXPECT_EQ(size.vertices, 4U * 10);
    EXPECT_EQ(size.baked_triangles, 2U * 9);
    EXPECT_EQ(size.mesh_triangles, 2U);
    EXPECT_EQ(size.placements, 40U);
    EXPECT_EQ(size.instances, 49U);
}

// Numbers go through three bytes and through floats: the last that holds is taken, the next is not.
TEST(SceneSize, IsHeldAgainstWhatShadersCanNumber) {
    const std::uint64_t before = memoryLimit();
    limitMemory(std::numeric_limits<std::uint64_t>::max());
    const std::uint64_t most = kBvhMostTriangles;
    EXPECT_EQ(refusal(SceneSize{.vertices = 100, .baked_triangles = most}), "");
    EXPECT_TRUE(
        contains(refusal(SceneSize{.vertices = 100, .baked_triangles = most + 1}), "16777217 triangles"));
    // Each kind alone would do.
    EXPECT_TRUE(contains(refusal(SceneSize{.vertices = 100,
                                           .baked_triangles = 12'005'000,
                                           .mesh_triangles = 6'055'200,
                                           .placements = 2,
                                           .instances = 3}),
                         "18060200 triangles (6055200 of them"));
    EXPECT_TRUE(contains(
        refusal(SceneSize{.vertices = 3, .mesh_triangles = 1, .placements = most, .instances = most}),
        "can be traced"));
    EXPECT_TRUE(contains(refusal(SceneSize{.vertices = std::uint64_t{1} << 40U}), "vertices, which take"));
    limitMemory(before);
}

TEST(SceneSize, IsHeldAgainstMemory) {
    gpu::testDevice();  // takes memory too
    const std::uint64_t before = memoryLimit();
    limitMemory(memoryInUse() + (std::uint64_t{64} << 20U));
    EXPECT_EQ(refusal(SceneSize{.vertices = 1000, .baked_triangles = 1000}), "");
    EXPECT_TRUE(contains(refusal(SceneSize{.vertices = 1'000'000, .baked_triangles = 2'000'000}),
                         "of memory beside"));
    RenderSettings settings;
    settings.size = uvec2(4096, 4096);
    const Scene scene = quads(2, false);
    EXPECT_TRUE(
        contains(refusal([&] { const Renderer renderer(gpu::testDevice(), scene, Camera{}, settings); }),
                 "a picture of 4096x4096 takes about"));
    limitMemory(before);
}

// The trees of both levels together, where each alone would do.
TEST(SceneSize, OfJoinedTreesIsChecked) {
    TwoLevelBvh tree;
    tree.baked.nodes.resize(1);
    tree.baked.triangle_ids.resize(std::size_t{kBvhMostTriangles} - 100);
    tree.meshes.resize(1);
    tree.meshes[0].nodes.resize(1);
    tree.meshes[0].triangle_ids.resize(101);
    const std::uint32_t counts[] = {kBvhMostTriangles - 100, 101};
    EXPECT_TRUE(contains(refusal([&] { joinLevels(tree, counts); }), "16777217 triangles and instances"));
}

TEST(Draws, OfVeryManyInstancesAreOneAndSeeTheSame) {
    const Scene apart = quads(40, true);
    const Scene together = quads(40, false);
    const GpuScene on_device(gpu::testDevice(), apart, detectEffects(apart), GpuScene::Options{});
    EXPECT_EQ(on_device.draws().size(), 1U);
    const Scene few = quads(10, true);
    EXPECT_EQ(GpuScene(gpu::testDevice(), few, detectEffects(few), GpuScene::Options{}).draws().size(), 100U);

    Camera camera;
    camera.kind = Camera::Kind::orthographic;
    camera.y_extent = 20.0F;
    camera.world_from_view = glm::translate(mat4(1.0F), vec3(20.0F, 20.0F, 5.0F));
    RenderSettings settings;
    settings.size = uvec2(160, 160);
    settings.bounces = 1;
    settings.layers = allLayers().without(LayerId::bounces);
    const Film a = renderFilm(apart, camera, settings, 2);
    const Film b = renderFilm(together, camera, settings, 2);
    // The same hits, so the same numbers: surfaces, their normals and their distances.
    for (const LayerId layer : {LayerId::albedo, LayerId::normal, LayerId::depth})
        EXPECT_EQ(a.layer(layer).texels, b.layer(layer).texels) << static_cast<int>(layer);
    EXPECT_EQ(a.mean.texels.size(), b.mean.texels.size());
    double covered = 0.0;
    for (std::size_t i = 0; i < a.layer(LayerId::albedo).texels.size(); ++i)
        covered += static_cast<double>(a.layer(LayerId::albedo).texels[i]);
    EXPECT_GT(covered, 0.0);
}

}  // namespace
}  // namespace licht
