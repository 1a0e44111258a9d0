// Two levels against one: the same scene with every instance baked is the naive reference.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "licht/film/film.h"
#include "licht/on_device/gpu_scene.h"
#include "licht/scene/instancing.h"
#include "licht/scene/tangents.h"
#include "licht/settings/settings.h"
#include "licht/shared/effects.h"
#include "licht/shared/geometry.h"
#include "samples/scenes/assembly.h"
#include "samples/scenes/shapes.h"
#include "support/gpu_test.h"
#include "support/render_test.h"

namespace licht {
namespace {

/// Knots of two kinds, turned, stretched by up to 1 : 3 and some of them mirrored, over a floor; a lamp and a
/// sky. Single-sided, so that culling must know fronts from backs.
Scene crowd(std::uint32_t count, const vec3& at = vec3(0.0F), AlphaMode alpha = AlphaMode::opaque) {
    Scene scene;
    scene.name = "crowd";
    const auto material = [&](const vec4& color) {
        Material m = lambert(1.0F);
        m.base_color = color;
        m.roughness = 0.4F;
        m.specular = 1.0F;
        m.alpha_mode = color.w < 1.0F ? alpha : AlphaMode::opaque;
        return addMaterial(scene, m);
    };
    const float opacity = alpha == AlphaMode::blend ? 0.6F : 1.0F;
    const std::uint32_t red = material(vec4(0.8F, 0.3F, 0.2F, opacity));
    const std::uint32_t blue = material(vec4(0.2F, 0.4F, 0.8F, 1.0F));
    const std::uint32_t grey = material(vec4(0.6F, 0.6F, 0.6F, 1.0F));
    Mesh knot = torusKnotMesh("Knot", red, {2.0F, 3.0F, 1.0F, 0.4F, 0.25F}, 64, 6);
    for (vec3& p : knot.positions) p += vec3(20.0F, -5.0F, 3.0F);  // far from its own origin
    const std::uint32_t knots = addMesh(scene, knot);
    const std::uint32_t cones = addMesh(scene, coneMesh("Cone", blue, 0.6F, 0.1F, 1.2F, 6));
    place(scene, quadMesh("floor", grey, at + vec3(-9, -1, 9), at + vec3(9, -1, 9), at + vec3(9, -1, -9),
                          at + vec3(-9, -1, -9)));

    std::mt19937 engine(5);
    const auto uniform = [&](float lower, float upper) {
        return lower + (upper - lower) * static_cast<float>(engine() >> 8U) * 0x1p-24F;
    };
    for (std::uint32_t i = 0; i < count; ++i) {
        const vec3 place_at = at + vec3(uniform(-7, 7), uniform(-0.5F, 3), uniform(-7, 7));
        const float angle = uniform(0, 6);
        const vec3 axis = glm::normalize(vec3(uniform(-1, 1), 1.0F, uniform(-1, 1)));
        const vec3 size(uniform(0.1F, 0.3F), uniform(0.1F, 0.3F), uniform(0.1F, 0.3F));
        mat4 m = glm::rotate(glm::translate(mat4(1.0F), place_at), angle, axis);
        m = glm::scale(m, i % 3 == 0 ? size * vec3(-1, 1, 1) : size);
        const bool knotted = i % 4 != 0;
        place(scene, knotted ? knots : cones, knotted ? glm::translate(m, vec3(-20.0F, 5.0F, -3.0F)) : m);
    }
    PunctualLight lamp;
    lamp.name = "lamp";
    lamp.position = at + vec3(2, 7, 3);
    lamp.intensity = vec3(150.0F);
    scene.lights.push_back(lamp);
    scene.environment = constantEnvironment(vec3(0.4F, 0.5F, 0.6F));
    scene.cameras.push_back(lookingCamera("camera", at + vec3(3, 5, 11), at + vec3(0, 0.5F, 0), 0.8F));
    return scene;
}

constexpr std::uint32_t kCount =
    800;  // of which 600 knots of 768 triangles: 460,000 saved; the cones are baked

RenderSettings small() {
    RenderSettings settings;
    settings.size = uvec2(64, 48);
    settings.seed = 3;
    return settings;
}

RenderSettings flattened(RenderSettings settings) {
    settings.flatten_instances = true;
    return settings;
}

/// Share of values that differ by more than that share of their magnitude.
double differing(const Image& a, const Image& b, float tolerance) {
    EXPECT_EQ(a.texels.size(), b.texels.size());
    std::size_t different = 0;
    for (std::size_t i = 0; i < a.texels.size(); ++i) {
        const bool same = a.texels[i] == b.texels[i] ||  // both infinite
                          std::abs(a.texels[i] - b.texels[i]) <=
                              tolerance * std::max(std::abs(a.texels[i]), std::abs(b.texels[i]));
        different += same ? 0U : 1U;
    }
    return static_cast<double>(different) / static_cast<double>(a.texels.size());
}

TEST(Instances, TheTestSceneHasBothLevels) {
    const Scene scene = crowd(kCount);
    const Instancing chosen = chooseInstanced(scene);
    EXPECT_EQ(chosen.count, 600U);
    EXPECT_EQ(scene.instances.size(), std::size_t{kCount} + 1);
    const Effects effects = detectEffects(scene);
    EXPECT_TRUE(effects.has(kEffectInstances));
    const GpuScene two(gpu::testDevice(), scene, effects, {});
    // The floor, 200 cones, and the knots as they are and mirrored.
    EXPECT_EQ(two.draws().size(), 1U + 200U + 2U);
}

// Raster hits: the two differ by the rounding of positions alone, about 1e-6 of the coordinates, so only
// pixels whose centre lies that close to a silhouette may see something else.
TEST(Instances, PrimaryHitsAreThoseOfTheFlattenedScene) {
    for (const vec3& at : {vec3(0.0F), vec3(300.0F, 20.0F, -200.0F)}) {
        const Scene scene = crowd(kCount, at);
        RenderSettings settings = small();
        settings.bounces = 0;
        settings.layers = {LayerId::albedo, LayerId::normal, LayerId::depth};
        const Film a = renderFilm(scene, scene.cameras[0], settings, 1);
        const Film b = renderFilm(scene, scene.cameras[0], flattened(settings), 1);
        EXPECT_LE(differing(a.layer(LayerId::albedo), b.layer(LayerId::albedo), 1e-5F), 0.002);
        EXPECT_LE(differing(a.layer(LayerId::depth), b.layer(LayerId::depth), 1e-4F), 0.002);
        // Shading normals change quickly over the thin tubes.
        EXPECT_LE(differing(a.layer(LayerId::normal), b.layer(LayerId::normal), 0.01F), 0.01);
    }
}

// A map that tilts all normals towards the bitangent, which changes sides where an instance is mirrored.
TEST(Instances, NormalMapsTiltThemAsFlattenedOnes) {
    Scene scene = crowd(kCount);
    Texture tilt;
    tilt.width = tilt.height = 1;
    tilt.bytes = {128, 220, 200, 255};
    scene.textures = {tilt};
    scene.materials[0].slots[kSlotNormal].texture = 0;
    for (Mesh& mesh : scene.meshes) {
        mesh.uv_sets.assign(1, {});
        for (const vec3& p : mesh.positions) mesh.uv_sets[0].emplace_back(p.x, p.y);
        deriveTangents(mesh, scene.materials[0].slots[kSlotNormal]);
    }
    RenderSettings settings = small();
    settings.bounces = 0;
    settings.layers = {LayerId::normal};
    const Film a = renderFilm(scene, scene.cameras[0], settings, 1);
    const Film b = renderFilm(scene, scene.cameras[0], flattened(settings), 1);
    EXPECT_LE(differing(a.layer(LayerId::normal), b.layer(LayerId::normal), 0.02F), 0.01);
    scene.materials[0].slots[kSlotNormal] = {};
    const Film untilted = renderFilm(scene, scene.cameras[0], settings, 1);
    EXPECT_GE(differing(a.layer(LayerId::normal), untilted.layer(LayerId::normal), 0.1F), 0.1)
        << "nothing is tilted";
}

// The same sample addresses, so the same paths but where rounding turns one at an edge. One bounce: light,
// its shadow ray, and one scattered ray. Two: rays that start on instances and meet others.
TEST(Instances, PathsAreThoseOfTheFlattenedScene) {
    const Scene scene = crowd(kCount);
    RenderSettings settings = small();
    for (const std::uint32_t bounces : {1U, 2U}) {
        settings.bounces = bounces;
        const Film a = renderFilm(scene, scene.cameras[0], settings, 1);
        const Film b = renderFilm(scene, scene.cameras[0], flattened(settings), 1);
        EXPECT_LE(differing(a.mean, b.mean, 1e-2F), 0.02) << bounces << " bounces";
    }
}

TEST(Instances, PictureIsThatOfTheFlattenedScene) {
    const Scene scene = crowd(kCount);
    RenderSettings other = flattened(small());
    other.seed = 4;
    expectSamePicture(renderFilm(scene, scene.cameras[0], small(), 48),
                      renderFilm(scene, scene.cameras[0], other, 48), "instances");
}

TEST(Instances, PictureIsThatOfTheFlattenedSceneFarFromTheOrigin) {
    const Scene scene = crowd(kCount, vec3(3000.0F, 100.0F, -2000.0F));
    RenderSettings other = flattened(small());
    other.seed = 4;
    expectSamePicture(renderFilm(scene, scene.cameras[0], small(), 32),
                      renderFilm(scene, scene.cameras[0], other, 32), "instances_far");
}

TEST(Instances, PartlyTransparentOnesGiveTheSamePicture) {
    const Scene scene = crowd(kCount, vec3(0.0F), AlphaMode::blend);
    RenderSettings other = flattened(small());
    other.seed = 4;
    expectSamePicture(renderFilm(scene, scene.cameras[0], small(), 32),
                      renderFilm(scene, scene.cameras[0], other, 32), "instances_alpha");
}

TEST(Instances, EverythingCompiledInGivesTheSamePicture) {
    const Scene scene = crowd(kCount);
    RenderSettings everything = small();
    everything.size = uvec2(32, 24);
    everything.all_effects = true;
    RenderSettings one = small();
    one.size = everything.size;
    EXPECT_LE(differing(renderFilm(scene, scene.cameras[0], one, 2).mean,
                        renderFilm(scene, scene.cameras[0], everything, 2).mean, 1e-5F),
              0.01);
}

TEST(Instances, QueuesGiveTheSameBits) {
    for (const AlphaMode alpha : {AlphaMode::opaque, AlphaMode::blend}) {
        const Scene scene = crowd(kCount, vec3(0.0F), alpha);
        RenderSettings queues = small();
        queues.queues = true;
        const Film a = renderFilm(scene, scene.cameras[0], small(), 1);
        const Film b = renderFilm(scene, scene.cameras[0], queues, 1);
        EXPECT_EQ(differing(a.mean, b.mean, 0.0F), 0.0);
    }
}

TEST(Instances, StorageBuffersGiveTheSameBits) {
    const Scene scene = crowd(kCount);
    RenderSettings storage = small();
    storage.storage_buffers = true;
    const Film a = renderFilm(scene, scene.cameras[0], small(), 1);
    const Film b = renderFilm(scene, scene.cameras[0], storage, 1);
    EXPECT_EQ(differing(a.mean, b.mean, 0.0F), 0.0);
}

// A record of 16 bytes and a transform of 64, four texels of 16 beside the BVH, and nodes of 64 bytes: its
// own, and of those above it no more than another.
TEST(Instances, MoreOfThemTakeLittleMemory) {
    constexpr std::uint64_t kMostPerInstance = 16 + 64 + 64 + 2 * 64;
    const auto geometryBytes = [](std::uint32_t count, bool baked) {
        const Scene scene = crowd(count);
        Effects effects = detectEffects(scene);
        if (baked) effects.on[kEffectInstances] = false;
        return GpuScene(gpu::testDevice(), scene, effects, {}).geometryBytes();
    };
    const std::uint64_t two_levels = geometryBytes(kCount, false);
    const std::uint64_t one_level = geometryBytes(kCount, true);
    EXPECT_LT(10 * two_levels, one_level);
    constexpr std::uint32_t kMore = 4 * kCount;
    const std::uint64_t more = geometryBytes(kMore, false) - two_levels;
    // A quarter of them are cones, which are baked: 24 triangles, each with its own vertices and indices, its
    // place in the BVH and as much of a node.
    constexpr std::uint64_t kMostPerCone = 16 + 24 * (3 * sizeof(VertexRecord) + 16 + 48 + 64);
    EXPECT_LE(more, std::uint64_t{kMore - kCount} * (3 * kMostPerInstance + kMostPerCone) / 4);
}

}  // namespace
}  // namespace licht
