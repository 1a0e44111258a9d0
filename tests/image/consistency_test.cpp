// What must not depend on how a picture is computed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "licht/film/error_estimate.h"
#include "licht/on_device/gpu_scene.h"
#include "licht/render/programs.h"
#include "licht/render/renderer.h"
#include "licht/shared/effects.h"
#include "licht/spirv/consistency_comp.h"
#include "samples/scenes/builtin.h"
#include "support/first_hits.h"
#include "support/gpu_test.h"
#include "support/render_test.h"

namespace licht {
namespace {

// "sunny": the terrain under a sun of 10 degrees.
Scene builtin(std::string_view name) {
    if (name != "sunny") return *makeBuiltinScene(name);
    Scene scene = *makeBuiltinScene("terrain", 5000);
    for (PunctualLight& light : scene.lights) light.angular_diameter = 0.17F;
    return scene;
}

RenderSettings small() {
    RenderSettings settings;
    settings.size = uvec2(48, 32);
    settings.seed = 7;
    return settings;
}

bool identical(const Image& a, const Image& b) {
    return a.texels.size() == b.texels.size() &&
           std::memcmp(a.texels.data(), b.texels.data(), a.texels.size() * sizeof(float)) == 0;
}

TEST(Repeatability, SameSeedGivesTheSameBits) {
    const Scene scene = builtin("cornell");
    const Film a = renderFilm(scene, scene.cameras[0], small(), 5);
    const Film b = renderFilm(scene, scene.cameras[0], small(), 5);
    EXPECT_TRUE(identical(a.mean, b.mean));
    EXPECT_TRUE(identical(a.variance, b.variance));
}

TEST(Repeatability, AnotherSeedGivesAnotherSampleOfTheSamePicture) {
    const Scene scene = builtin("cornell");
    RenderSettings other = small();
    other.seed = 8;
    const Film a = renderFilm(scene, scene.cameras[0], small(), 256);
    const Film b = renderFilm(scene, scene.cameras[0], other, 256);
    EXPECT_FALSE(identical(a.mean, b.mean));
    expectSamePicture(a, b, "another_seed");
}

TEST(Repeatability, SplitRangesMergeToTheWhole) {
    const Scene scene = builtin("cornell");
    const Film whole = renderFilm(scene, scene.cameras[0], small(), 12);
    RenderSettings rest = small();
    rest.first_sample = 5;
    const Film merged = mergeFilms(renderFilm(scene, scene.cameras[0], small(), 5),
                                   renderFilm(scene, scene.cameras[0], rest, 7));
    ASSERT_EQ(merged.samples, 12U);
    for (std::size_t i = 0; i < whole.mean.texels.size(); ++i)
        ASSERT_NEAR(merged.mean.texels[i], whole.mean.texels[i],
                    4 * 6e-8F * whole.mean.texels[i]);  // three roundings to fp32
    for (std::size_t i = 0; i < whole.variance.texels.size(); ++i) {
        // The rounding of each part's mean enters the squares as (mean * 6e-8) * spread.
        const float mean = whole.mean.texels[i / 3 * 4 + i % 3];
        ASSERT_NEAR(merged.variance.texels[i], whole.variance.texels[i],
                    1e-5F * (whole.variance.texels[i] + mean * mean * 1e-4F));
    }
}

TEST(Repeatability, MovingTheCameraAwayAndBackStartsAnew) {
    const Scene scene = builtin("cornell");
    const Film fresh = renderFilm(scene, scene.cameras[0], small(), 3);
    Renderer renderer(gpu::testDevice(), scene, scene.cameras[0], small());
    renderer.renderSample();
    Camera moved = scene.cameras[0];
    moved.world_from_view[3].x += 0.1F;
    renderer.setCamera(moved);
    renderer.renderSample();
    EXPECT_EQ(renderer.samples(), 1U);
    renderer.setCamera(scene.cameras[0]);
    for (int i = 0; i < 3; ++i) renderer.renderSample();
    EXPECT_TRUE(identical(renderer.readFilm().mean, fresh.mean));
}

// sqrt(mean of variance / (mean^2 + 0.01 * (the picture's mean)^2)), worked out by hand: the picture's mean
// is 2.
TEST(Estimators, RelativeErrorIsItsDefinition) {
    Film film;
    film.size = uvec2(2, 1);
    film.mean = Image(2, 1, 4);
    film.mean.texels = {1.0F, 1.0F, 1.0F, 1.0F, 3.0F, 3.0F, 3.0F, 1.0F};
    film.variance = Image(2, 1, 3);
    film.variance.texels = {0.1F, 0.1F, 0.1F, 0.2F, 0.2F, 0.2F};
    film.samples = 1;
    EXPECT_LT(relativeError(film), 0.0) << "unknown with one sample";
    film.samples = 2;
    EXPECT_NEAR(relativeError(film), std::sqrt(0.5 * (0.1 / 1.04 + 0.2 / 9.04)), 1e-7);
}

TEST(Estimators, BothFormsOfTheRenderingEquationAgree) {
    const Scene scene = builtin("cornell");
    RenderSettings hemisphere = small();
    hemisphere.direct = DirectLight::hemisphere;
    hemisphere.seed = 9;
    // The hemisphere form meets the small light seldom: its means are near normal only with many samples.
    const Film a = renderFilm(scene, scene.cameras[0], small(), 512);
    const Film b = renderFilm(scene, scene.cameras[0], hemisphere, 2048);
    for (int c = 0; c < 3; ++c) {
        const PictureMean ma = pictureMean(a, c);
        const PictureMean mb = pictureMean(b, c);
        EXPECT_NEAR(ma.mean, mb.mean, 4.5 * std::hypot(ma.standard_error, mb.standard_error));
        EXPECT_LT(mb.standard_error, 0.05 * mb.mean) << "too noisy to tell anything";
    }
}

TEST(Estimators, RouletteKeepsThePicture) {
    const Scene scene = builtin("cornell");
    RenderSettings roulette = small();
    roulette.roulette_start = 0;
    roulette.seed = 10;
    expectSamePicture(renderFilm(scene, scene.cameras[0], roulette, 512),
                      renderFilm(scene, scene.cameras[0], small(), 256), "roulette");
}

// What a scene does not call for has no memory: its name in the shaders is bound to the few zero bytes that
// stand for "none".
TEST(Effects, AbsentOnesOwnNoBuffers) {
    gpu::Device& device = gpu::testDevice();
    const auto absent = [&](const char* scene_name) {
        const Scene scene = builtin(scene_name);
        GpuScene::Options options;
        options.storage_buffers = true;  // so that every record has a buffer of its own name
        const GpuScene gpu_scene(device, scene, detectEffects(scene), options);
        std::vector<std::string> names;
        for (const gpu::BoundResource& r : gpu_scene.resources()) {
            const gpu::Buffer* const* buffer = std::get_if<const gpu::Buffer*>(&r.resource);
            if (buffer != nullptr && (*buffer)->name() == "none") names.push_back(r.name);
        }
        return names;
    };
    const std::vector<std::string> cornell = absent("cornell");
    for (const char* name : {"Tangents", "Colors", "ExtraUvs", "Textures", "SrgbTable", "texel_pages",
                             "LightTree", "InstanceTransforms"})
        EXPECT_EQ(std::count(cornell.begin(), cornell.end(), name), 1) << name;
    const std::vector<std::string> furnace = absent("furnace");
    for (const char* name : {"Lights", "LightAlias"})
        EXPECT_EQ(std::count(furnace.begin(), furnace.end(), name), 1) << name;
    const std::vector<std::string> gallery = absent("gallery");
    for (const char* name :
         {"Tangents", "Textures", "SrgbTable", "texel_pages", "LightTree", "Lights", "LightAlias"})
        EXPECT_EQ(std::count(gallery.begin(), gallery.end(), name), 0) << name;
}

// lavapipe 22.3 compiles a program anew whenever a uniform that decides a branch might have changed (see
// scene.glsl).
TEST(Effects, ProgramsReadNoUniformBuffers) {
    RenderSettings settings;
    settings.layers.add(LayerId::albedo);
    const Programs programs(gpu::testDevice(), {}, settings);
    for (const gpu::Program* program :
         {&programs.gbuffer, &programs.path, &programs.accumulate, &programs.layers, &programs.tonemap}) {
        EXPECT_FALSE(program->bindings().empty());
        for (const gpu::ReflectedBinding& binding : program->bindings())
            EXPECT_NE(binding.type, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER)
                << program->name() << ": " << binding.name;
    }
}

class EveryScene : public testing::TestWithParam<const char*> {};

// Programs specialised to the scene against programs with everything compiled in. The sample addresses are
// the same, so only the compiler's freedom in fp32 may tell them apart; a rounding that turns a path at an
// edge changes that path wholly, which the z-test allows and counts.
TEST_P(EveryScene, SpecialisedProgramsGiveTheSamePicture) {
    const Scene scene = builtin(GetParam());
    RenderSettings everything = small();
    everything.all_effects = true;
    const Film a = renderFilm(scene, scene.cameras[0], small(), 16);
    const Film b = renderFilm(scene, scene.cameras[0], everything, 16);
    // Where most of the scene shines, the specialised program does not sample lights at all: another
    // estimator of the same picture.
    const Effects effects = detectEffects(scene);
    const bool same_estimator = effects.has(kEffectLightTriangles) || !effects.has(kEffectEmission);
    std::size_t different = 0;
    for (std::size_t i = 0; i < a.mean.texels.size(); ++i)
        different +=
            std::abs(a.mean.texels[i] - b.mean.texels[i]) > 1e-5F * std::abs(b.mean.texels[i]) ? 1U : 0U;
    if (same_estimator) {
        EXPECT_LE(static_cast<double>(different), 0.01 * static_cast<double>(a.mean.texels.size()));
    }
    expectSamePicture(a, b, std::string("specialised_") + GetParam());
}

TEST_P(EveryScene, StorageBuffersGiveTheSameBits) {
    const Scene scene = builtin(GetParam());
    RenderSettings storage = small();
    storage.storage_buffers = true;
    EXPECT_TRUE(identical(renderFilm(scene, scene.cameras[0], small(), 2).mean,
                          renderFilm(scene, scene.cameras[0], storage, 2).mean));
}

// The same estimator cut where rays are traced.
TEST_P(EveryScene, QueuesGiveTheSameBits) {
    const Scene scene = builtin(GetParam());
    RenderSettings queues = small();
    queues.queues = true;
    const Film one_kernel = renderFilm(scene, scene.cameras[0], small(), 2);
    // In lanes that are refilled, and a ray a thread.
    for (const std::uint32_t rays_per_thread : {3U, 1U}) {
        queues.rays_per_thread = rays_per_thread;
        EXPECT_TRUE(identical(one_kernel.mean, renderFilm(scene, scene.cameras[0], queues, 2).mean));
    }
}

// One path a thread is the naive form of several. 7 does not divide the picture's rows.
TEST_P(EveryScene, PathsOneAfterTheOtherGiveTheSameBits) {
    const Scene scene = builtin(GetParam());
    RenderSettings one = small();
    one.paths_per_thread = 1;
    RenderSettings several = small();
    several.paths_per_thread = 7;
    EXPECT_TRUE(identical(renderFilm(scene, scene.cameras[0], one, 2).mean,
                          renderFilm(scene, scene.cameras[0], several, 2).mean));
}

// Every pixel's primary hit, traced again from the eye through the same point: the same primitive, or the
// neighbour across an edge that lies within rounding of it.
TEST_P(EveryScene, TracedPrimaryHitsAreTheRasterisedOnes) {
    const Scene scene = builtin(GetParam());
    const uvec2 size(160, 120);
    struct Outcome {
        uint hits, different, far_away, lost;
    };
    Outcome result;
    std::memcpy(&result, lookAtFirstHits(scene, size, "retrace", consistency_comp, sizeof(result)).data(),
                sizeof(result));
    if (scene.instances.empty()) {
        EXPECT_EQ(result.hits, 0U);
        return;
    }
    EXPECT_GT(result.hits, size.x * size.y / 2);
    EXPECT_EQ(result.lost, 0U) << "rays that met nothing where the rasteriser saw a surface";
    // Rasterisers snap vertices to 1/256 pixel, so a pixel that close to an edge may see the neighbour.
    EXPECT_LE(result.different, result.hits / 100);
    // A different primitive at another depth is a silhouette, rarer still.
    EXPECT_LE(result.far_away, result.hits / 500);
}

INSTANTIATE_TEST_SUITE_P(Builtin, EveryScene,
                         testing::Values("cornell", "furnace", "gallery", "sunny", "empty"),
                         [](const auto& instance) { return std::string(instance.param); });

}  // namespace
}  // namespace licht
