// What the sequences and the ways to draw from the environment do to pictures: the same mean, and the noise
// that each promises.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "licht/core/error.h"
#include "licht/on_device/gpu_scene.h"
#include "licht/render/renderer.h"
#include "licht/shared/light.h"
#include "samples/scenes/assembly.h"
#include "samples/scenes/builtin.h"
#include "samples/scenes/shapes.h"
#include "support/gpu_test.h"
#include "support/render_test.h"
#include "support/slope.h"

namespace licht {
namespace {

constexpr std::uint32_t kSide = 24;

RenderSettings settingsFor(Sequence sampler, DirectLight direct = DirectLight::mis) {
    RenderSettings settings;
    settings.size = uvec2(kSide);
    settings.bounces = 1;
    settings.direct = direct;
    settings.sampler = sampler;
    return settings;
}

/// Root mean square error of a channel, and of what the film itself expects.
struct Error {
    double found = 0.0;
    double expected = 0.0;
};
Error errorOf(const Film& film, const Film& reference) {
    Error error;
    for (std::size_t y = 0; y < kSide; ++y) {
        for (std::size_t x = 0; x < kSide; ++x) {
            const auto at = [&](const Image& image) {
                return static_cast<double>(image.at(static_cast<int>(x), static_cast<int>(y), 1));
            };
            error.found += std::pow(at(film.mean) - at(reference.mean), 2.0) / (kSide * kSide);
            error.expected += at(film.variance) / (kSide * kSide);
        }
    }
    return {std::sqrt(error.found), std::sqrt(error.expected)};
}

/// After 4, 8, ... 256 samples.
std::vector<Error> errors(Sequence sampler, DirectLight direct, const Film& reference) {
    RenderSettings settings = settingsFor(sampler, direct);
    settings.blue_bits = 8;
    Renderer renderer(gpu::testDevice(), litFloor(), litFloorCamera(), settings);
    std::vector<Error> result;
    for (std::uint32_t wanted = 4; wanted <= 256; wanted *= 2) {
        while (renderer.samples() < wanted) renderer.renderSample();
        result.push_back(errorOf(renderer.readFilm(), reference));
    }
    return result;
}

double slope(const std::vector<Error>& errors) {
    std::vector<double> found;
    for (const Error& error : errors) found.push_back(error.found);
    return slopeOf(found);
}

// Errors of 576 independent pixels are known to 3 %, 0.043 in log2. Over seven octaves whose errors share
// samples that leaves the slope uncertain by 0.043 * sqrt(2) / 6, 0.01.
TEST(SmoothScene, errorsFallAsTheSequencePromises) {
    RenderSettings settings = settingsFor(Sequence::sobol, DirectLight::area);
    settings.seed = 1;
    const Film reference = renderFilm(litFloor(), litFloorCamera(), settings, 2048);
    const std::vector<Error> random = errors(Sequence::random, DirectLight::mis, reference);
    EXPECT_NEAR(slope(random), -0.5, 0.05);
    // What the film says of its own error is right for independent samples ...
    EXPECT_NEAR(random.back().found / random.back().expected, 1.0, 4.5 * 0.03);
    const auto expectSlope = [&](Sequence sampler, DirectLight direct, double steepest, const char* name) {
        const std::vector<Error> even = errors(sampler, direct, reference);
        RecordProperty(std::string(name) + "_slope", std::to_string(slope(even)));
        RecordProperty(std::string(name) + "_gain", std::to_string(random.back().found / even.back().found));
        EXPECT_LT(slope(even), steepest) << name;
        // ... and an upper bound for evenly spread ones.
        for (std::size_t i = 0; i < even.size(); ++i) {
            EXPECT_LT(even[i].found, even[i].expected) << name << " " << (4U << i);
            EXPECT_LT(even[i].found, random[i].found) << name << " " << (4U << i);
        }
        EXPECT_LT(even.back().found, 0.5 * random.back().found) << name;
    };
    // Scattering sees the lamp's rim, and an edge gives -3/4; it takes part with a small weight.
    expectSlope(Sequence::sobol, DirectLight::mis, -0.65, "sobol");
    expectSlope(Sequence::blue, DirectLight::mis, -0.65, "blue");
    // Points on the lamp see no edge: -3/2, with the places in the pixel that all pixels share, -1.
    expectSlope(Sequence::sobol, DirectLight::area, -0.9, "sobol_area");
}

TEST(Sequences, showTheSamePicture) {
    const Scene scene = *makeBuiltinScene("cornell");
    std::vector<Film> films;
    for (const Sequence sampler : {Sequence::random, Sequence::sobol, Sequence::blue}) {
        RenderSettings settings;
        settings.size = uvec2(96);
        settings.bounces = 4;
        settings.sampler = sampler;
        films.push_back(renderFilm(scene, scene.cameras[0], settings, 64));
    }
    expectSamePicture(films[1], films[0], "sampler_sobol");
    expectSamePicture(films[2], films[0], "sampler_blue");
}

// The index of a sample has 32 bits: the last one is drawn, and then it is said that there are no more.
TEST(Sequences, endWithTheLastIndex) {
    for (const Sequence sampler : {Sequence::sobol, Sequence::blue, Sequence::random}) {
        RenderSettings settings = settingsFor(sampler);
        settings.size = uvec2(8);
        settings.first_sample = 0xfffffff8U;
        Renderer renderer(gpu::testDevice(), litFloor(), litFloorCamera(), settings);
        for (int i = 0; i < 8; ++i) renderer.renderSample();
        EXPECT_THROW(renderer.renderSample(), InputError);
        EXPECT_EQ(renderer.samples(), 8U);
        EXPECT_EQ(renderer.statistics().nonfinite_samples, 0U);
    }
}

TEST(EnvironmentSampling, tablesAreThereWhereTheyAreCalledFor) {
    const auto extent = [](const Scene& scene, EnvironmentSampling how) {
        GpuScene::Options options;
        options.environment_sampling = how;
        const GpuScene gpu_scene(gpu::testDevice(), scene, detectEffects(scene), options);
        for (const gpu::BoundResource& r : gpu_scene.resources())
            if (r.name == "environment_table") {
                const VkExtent2D size = std::get<gpu::SampledImage>(r.resource).image->extent();
                return uvec2(size.width, size.height);
            }
        return uvec2(0);
    };
    Scene scene = litFloor();
    EXPECT_EQ(extent(scene, EnvironmentSampling::alias), uvec2(1, 1));
    scene.environment = Environment{"sky", Image(32, 16, 3)};
    std::fill(scene.environment->radiance.texels.begin(), scene.environment->radiance.texels.end(), 1.0F);
    EXPECT_EQ(extent(scene, EnvironmentSampling::alias), uvec2(32, 16));
    EXPECT_EQ(extent(scene, EnvironmentSampling::inversion), uvec2(33, 16));
    EXPECT_EQ(extent(scene, EnvironmentSampling::rejection), uvec2(32, 16));
}

TEST(EnvironmentSampling, everyWayShowsTheSamePicture) {
    Scene scene;
    scene.materials = {lambert(0.5F)};
    Mesh sphere = sphereMesh("sphere", 0, 1.0F, 32, 16);
    place(scene, std::move(sphere));
    place(scene, quadMesh("floor", 0, vec3(-4, -1, 4), vec3(4, -1, 4), vec3(4, -1, -4), vec3(-4, -1, -4)));
    Environment sky{"sky", Image(32, 16, 3)};
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 32; ++x)
            for (int c = 0; c < 3; ++c)
                sky.radiance.at(x, y, c) =
                    0.2F + static_cast<float>(16 - y) / 16.0F + (x == 11 && y == 4 ? 8.0F : 0.0F);
    scene.environment = sky;
    std::vector<Film> films;
    for (const EnvironmentSampling how :
         {EnvironmentSampling::alias, EnvironmentSampling::inversion, EnvironmentSampling::rejection}) {
        for (const bool queues : {false, true}) {
            RenderSettings settings;
            settings.size = uvec2(48);
            settings.bounces = 2;
            settings.sampler = Sequence::random;
            settings.environment_sampling = how;
            settings.queues = queues;
            Renderer renderer(gpu::testDevice(), scene, downCamera(vec3(0.0F), 2.0F, 5.0F), settings);
            for (int i = 0; i < 32; ++i) renderer.renderSample();
            films.push_back(renderer.readFilm());
            const RenderStatistics statistics = renderer.statistics();
            if (how != EnvironmentSampling::rejection) {
                EXPECT_EQ(statistics.environment_samples, 0U);
                continue;
            }
            // At most as many samples as vertices, and several tries each where the map is far from even.
            EXPECT_GT(statistics.environment_samples, statistics.primary_rays / 2);
            EXPECT_LE(statistics.environment_samples, statistics.primary_rays + statistics.bounce_rays);
            EXPECT_GT(statistics.environment_tries, 4 * statistics.environment_samples);
            EXPECT_LE(statistics.environment_tries, kEnvironmentMostTries * statistics.environment_samples);
        }
        EXPECT_EQ(films[films.size() - 2].mean.texels, films.back().mean.texels) << "queues draw the same";
    }
    expectSamePicture(films[2], films[0], "environment_inversion");
    expectSamePicture(films[4], films[0], "environment_rejection");
}

}  // namespace
}  // namespace licht
