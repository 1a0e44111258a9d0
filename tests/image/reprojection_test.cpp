// A moving camera: what earlier views have told is brought to the present one, nowhere else, and gives way.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <string>

#include "licht/measure/metrics.h"
#include "licht/run/temporal_accuracy.h"
#include "samples/scenes/assembly.h"
#include "samples/scenes/builtin.h"
#include "samples/scenes/shapes.h"
#include "support/gpu_test.h"
#include "support/render_test.h"

namespace licht {
namespace {

RenderSettings moving(uvec2 size, Denoise denoise) {
    RenderSettings settings;
    settings.size = size;
    settings.denoise = denoise;
    settings.moves = true;
    return settings;
}

/// Aside by a share of its distance to the origin's depth.
Camera walked(Camera camera, float metres) {
    camera.world_from_view[3] += metres * camera.world_from_view[0];
    return camera;
}

void draw(Renderer& renderer, int samples) {
    for (int i = 0; i < samples; ++i) renderer.renderSample();
}

class Reprojection : public testing::TestWithParam<Denoise> {};

// The exact running mean, of the samples that a still has.
TEST_P(Reprojection, AtRestIsTheStill) {
    const Scene scene = *makeBuiltinScene("cornell");
    RenderSettings settings = moving(uvec2(32, 32), GetParam());
    Renderer renderer(gpu::testDevice(), scene, scene.cameras[0], settings);
    draw(renderer, 5);
    const Film film = renderer.readFilm();
    settings.moves = false;
    settings.denoise = Denoise::spatiotemporal;
    const Film still = renderFilm(scene, scene.cameras[0], settings, 5);
    EXPECT_EQ(film.unfiltered.texels, still.unfiltered.texels);
    EXPECT_EQ(film.mean.texels,
              GetParam() == Denoise::temporal ? still.unfiltered.texels : still.mean.texels);
}

TEST_P(Reprojection, ACutIsAFreshStart) {
    const Scene scene = *makeBuiltinScene("cornell");
    const RenderSettings settings = moving(uvec2(32, 24), GetParam());
    const Camera there = walked(scene.cameras[0], 0.04F);
    Renderer renderer(gpu::testDevice(), scene, scene.cameras[0], settings);
    draw(renderer, 3);
    renderer.setCamera(walked(scene.cameras[0], 0.02F));
    draw(renderer, 2);
    renderer.setCamera(there, ViewChange::cut);
    draw(renderer, 2);
    const Film fresh = renderFilm(scene, there, settings, 2);
    EXPECT_EQ(renderer.readFilm().mean.texels, fresh.mean.texels);
    EXPECT_EQ(renderer.readFilm().variance.texels, fresh.variance.texels);
    // Another size is another picture.
    renderer.setCamera(scene.cameras[0]);
    draw(renderer, 1);
    renderer.resize(uvec2(20, 30));
    draw(renderer, 2);
    RenderSettings other = settings;
    other.size = uvec2(20, 30);
    EXPECT_EQ(renderer.readFilm().mean.texels, renderFilm(scene, scene.cameras[0], other, 2).mean.texels);
}

INSTANTIATE_TEST_SUITE_P(Modes, Reprojection, testing::Values(Denoise::temporal, Denoise::spatiotemporal),
                         [](const auto& mode) { return std::string(nameOf(mode.param)); });

// Without a filter nothing is kept, but the samples are others, or their noise would stand still.
TEST(Moving, ViewsHaveSamplesOfTheirOwn) {
    const Scene scene = *makeBuiltinScene("cornell");
    RenderSettings settings = moving(uvec2(24, 24), Denoise::none);
    const Camera there = walked(scene.cameras[0], 0.02F);
    Renderer renderer(gpu::testDevice(), scene, scene.cameras[0], settings);
    draw(renderer, 3);
    renderer.setCamera(there);
    draw(renderer, 2);
    settings.first_sample = 3;
    EXPECT_EQ(renderer.readFilm().mean.texels, renderFilm(scene, there, settings, 2).mean.texels);
}

/// A floor and a wall with a spot's sharp light on them, seen along -Z: no noise but that of edges.
Scene spotlitCorner() {
    Scene scene;
    Material white;
    white.base_color = vec4(0.8F, 0.8F, 0.8F, 1.0F);
    white.roughness = 1.0F;
    const std::uint32_t material = addMaterial(scene, white);
    place(scene,
          quadMesh("wall", material, vec3(-4, -4, -5), vec3(4, -4, -5), vec3(4, 4, -5), vec3(-4, 4, -5)));
    PunctualLight light;
    light.kind = PunctualLight::Kind::spot;
    light.intensity = vec3(40.0F);
    light.position = vec3(1.0F, 1.0F, 0.0F);
    light.direction = glm::normalize(vec3(-0.2F, -0.2F, -1.0F));
    light.inner_cone = 0.1F;  // its light ends within the picture
    light.outer_cone = 0.3F;
    scene.lights.push_back(light);
    Camera camera;
    camera.y_fov = 0.9F;
    scene.cameras.push_back(camera);
    return scene;
}

/// How far b is moved against a along x and y, in pixels: the least squares of a's gradient times the shift
/// against their difference (Lucas, Kanade 1981).
vec2 shiftBetween(const Image& a, const Image& b) {
    glm::dmat2 sums(0.0);
    glm::dvec2 right(0.0);
    for (int y = 1; y + 1 < a.height; ++y) {
        for (int x = 1; x + 1 < a.width; ++x) {
            const glm::dvec2 g(
                0.5 * (static_cast<double>(a.at(x + 1, y, 0)) - static_cast<double>(a.at(x - 1, y, 0))),
                0.5 * (static_cast<double>(a.at(x, y + 1, 0)) - static_cast<double>(a.at(x, y - 1, 0))));
            sums += glm::outerProduct(g, g);
            right -= g * (static_cast<double>(b.at(x, y, 0)) - static_cast<double>(a.at(x, y, 0)));
        }
    }
    return vec2(glm::inverse(sums) * right);
}

// Rolled by 90 degrees and back in 256 frames, the picture is where it was, with the light that it had.
TEST(Moving, TurningThereAndBackMovesNothing) {
    const Scene scene = spotlitCorner();
    RenderSettings settings = moving(uvec2(64, 64), Denoise::temporal);
    settings.bounces = 1;
    Renderer renderer(gpu::testDevice(), scene, scene.cameras[0], settings);
    constexpr int kFrames = 256;
    for (int frame = 0; frame <= kFrames; ++frame) {
        const int steps = frame <= kFrames / 2 ? frame : kFrames - frame;
        Camera camera = scene.cameras[0];
        camera.world_from_view = glm::rotate(
            camera.world_from_view, kPi * static_cast<float>(steps) / kFrames, vec3(0.0F, 0.0F, 1.0F));
        renderer.setCamera(camera);
        renderer.renderSample();
    }
    const Image turned = colorOf(renderer.readFilm());
    settings.moves = false;
    settings.denoise = Denoise::none;
    const Image still = colorOf(renderFilm(scene, scene.cameras[0], settings, 64));
    const vec2 shift = shiftBetween(still, turned);
    EXPECT_LT(std::abs(shift.x), 0.05F);
    EXPECT_LT(std::abs(shift.y), 0.05F);
    const double energy = channelMeans(turned)[0] / channelMeans(still)[0];
    EXPECT_NEAR(energy, 1.0, 0.005);
}

/// Of the picture's pixels around which there is nothing nearer than `depth`: an edge may run between
/// samples.
float brightestBeyond(float depth, const Image& picture, const Image& depths) {
    float brightest = 0.0F;
    for (int y = 1; y + 1 < depths.height; ++y) {
        for (int x = 1; x + 1 < depths.width; ++x) {
            float nearest = depths.at(x, y, 0);
            for (int i = 0; i < 9; ++i)
                nearest = std::min(nearest, depths.at(x + i % 3 - 1, y + i / 3 - 1, 0));
            if (nearest > depth) brightest = std::max(brightest, picture.at(x, y, 0));
        }
    }
    return brightest;
}

class LightStays : public testing::TestWithParam<bool> {};

// Behind what moved aside lies another surface, and light is never brought to it from elsewhere: a dark wall
// behind a bright board stays dark, whether or not they are one mesh.
TEST_P(LightStays, OnItsSurface) {
    Scene scene;
    Material bright;
    bright.base_color = vec4(0.9F, 0.9F, 0.9F, 1.0F);
    bright.roughness = 1.0F;
    const std::uint32_t white = addMaterial(scene, bright);
    Mesh wall =
        quadMesh("wall", white, vec3(-9, -9, -10), vec3(9, -9, -10), vec3(9, 9, -10), vec3(-9, 9, -10));
    const Mesh board =
        quadMesh("board", white, vec3(-1, -9, -4), vec3(0, -9, -4), vec3(0, 9, -4), vec3(-1, 9, -4));
    if (GetParam())
        appendMesh(wall, board);
    else
        place(scene, board);
    place(scene, wall);
    // It lights the board alone, from its front; the wall has none.
    PunctualLight light;
    light.kind = PunctualLight::Kind::spot;
    light.intensity = vec3(1000.0F);
    light.position = vec3(-0.5F, 0.0F, 0.0F);
    light.direction = vec3(0.0F, 0.0F, -1.0F);
    light.inner_cone = 0.05F;
    light.outer_cone = 0.1F;
    scene.lights.push_back(light);
    Camera camera;
    camera.y_fov = 0.6F;
    scene.cameras.push_back(camera);
    RenderSettings settings = moving(uvec2(48, 32), Denoise::temporal);
    settings.bounces = 1;
    Renderer renderer(gpu::testDevice(), scene, camera, settings);
    RenderSettings plain = settings;
    plain.moves = false;
    plain.denoise = Denoise::none;
    plain.layers.add(LayerId::depth);
    Renderer truth(gpu::testDevice(), scene, camera, plain);
    for (int frame = 0; frame < 24; ++frame) {
        const Camera now = walked(camera, 0.04F * static_cast<float>(frame));
        renderer.setCamera(now);
        renderer.renderSample();
        const Image picture = colorOf(renderer.readFilm());
        truth.setCamera(now);
        draw(truth, 4);
        const Image depths = truth.readFilm().layer(LayerId::depth);
        EXPECT_EQ(brightestBeyond(9.9F, picture, depths), 0.0F) << frame;
    }
}

INSTANTIATE_TEST_SUITE_P(Moving, LightStays, testing::Bool(), [](const auto& one_mesh) {
    return std::string(one_mesh.param ? "OfOneMesh" : "OfTwoMeshes");
});

/// A mirror before the camera that shows a board behind it, which a spot lights: no noise.
Scene mirroredSpot() {
    Scene scene;
    Material silver;
    silver.base_color = vec4(0.9F, 0.9F, 0.9F, 1.0F);
    silver.roughness = 0.0F;
    place(scene, quadMesh("mirror", addMaterial(scene, silver), vec3(-4, -4, -5), vec3(4, -4, -5),
                          vec3(4, 4, -5), vec3(-4, 4, -5)));
    Material white;
    white.base_color = vec4(0.8F, 0.8F, 0.8F, 1.0F);
    white.metallic = 0.0F;
    white.specular = 0.0F;
    place(scene, quadMesh("board", addMaterial(scene, white), vec3(9, -9, 3), vec3(-9, -9, 3), vec3(-9, 9, 3),
                          vec3(9, 9, 3)));
    PunctualLight light;
    light.kind = PunctualLight::Kind::spot;
    light.intensity = vec3(100.0F);
    light.position = vec3(0.0F, 0.0F, -2.0F);
    light.direction = vec3(0.0F, 0.0F, 1.0F);
    light.inner_cone = 0.1F;
    light.outer_cone = 0.3F;
    scene.lights.push_back(light);
    Camera camera;
    camera.y_fov = 0.5F;
    scene.cameras.push_back(camera);
    return scene;
}

// What a mirror shows moves as its image does, not as the mirror: it would lag by half a pixel a frame.
TEST(Moving, MirrorsDoNotSmear) {
    const Scene scene = mirroredSpot();
    RenderSettings settings = moving(uvec2(64, 48), Denoise::temporal);
    settings.bounces = 2;
    Renderer renderer(gpu::testDevice(), scene, scene.cameras[0], settings);
    constexpr int kFrames = 16;
    const auto cameraAt = [&](int frame) {
        return walked(scene.cameras[0], 0.05F * static_cast<float>(frame));
    };
    for (int frame = 0; frame < kFrames; ++frame) {
        renderer.setCamera(cameraAt(frame));
        renderer.renderSample();
    }
    const Image moved_picture = colorOf(renderer.readFilm());
    settings.moves = false;
    settings.denoise = Denoise::none;
    const Image truth = colorOf(renderFilm(scene, cameraAt(kFrames - 1), settings, 64));
    // The spot's rim is as sharp as two pixels, and resampled sixteen times; moved as the mirror is, the
    // picture would be off by more than its light.
    EXPECT_LT(relMse(moved_picture, truth), 1e-2);
    EXPECT_NEAR(channelMeans(moved_picture)[0] / channelMeans(truth)[0], 1.0, 0.01);
}

// Paths that go through queues tell the same. The sums are in another order, so a rounding may differ.
TEST(Moving, KernelAndQueuesTellAlike) {
    const Scene scene = *makeBuiltinScene("gallery");
    std::array<Image, 2> pictures;
    for (const bool queues : {false, true}) {
        RenderSettings settings = moving(uvec2(48, 27), Denoise::temporal);
        settings.queues = queues;
        Renderer renderer(gpu::testDevice(), scene, scene.cameras[0], settings);
        for (int frame = 0; frame < 4; ++frame) {
            renderer.setCamera(walked(scene.cameras[0], 0.02F * static_cast<float>(frame)));
            renderer.renderSample();
        }
        pictures[queues ? 1 : 0] = colorOf(renderer.readFilm());
    }
    EXPECT_LT(relMse(pictures[1], pictures[0]), 1e-6);
}

// Of raw frames at most a third and an eighth; flicker of the filtered ones a fifth.
TEST(Moving, NoiseGoes) {
    const Scene scene = *makeBuiltinScene("cornell");
    std::vector<PathFrame> path;
    for (int i = 0; i < 12; ++i) path.push_back({walked(scene.cameras[0], 0.006F * static_cast<float>(i))});
    RenderSettings settings;
    settings.size = uvec2(96, 96);
    const TemporalAccuracy accuracy = measureTemporal(gpu::testDevice(), scene, path, settings, {1, 64});
    ASSERT_EQ(accuracy.modes.size(), 3U);
    const double raw = accuracy.modes[0].relMse();
    EXPECT_LT(3.0 * accuracy.modes[1].relMse(), raw);
    EXPECT_LT(8.0 * accuracy.modes[2].relMse(), raw);
    EXPECT_LT(5.0 * accuracy.modes[2].flicker, accuracy.modes[0].flicker);
}

// Come to rest, it has no more error than the samples since then would have alone.
TEST(Moving, ComesToRest) {
    const Scene scene = *makeBuiltinScene("cornell");
    RenderSettings settings = moving(uvec2(48, 48), Denoise::temporal);
    Renderer renderer(gpu::testDevice(), scene, scene.cameras[0], settings);
    for (int i = 1; i <= 12; ++i) {
        renderer.renderSample();
        renderer.setCamera(walked(scene.cameras[0], 0.008F * static_cast<float>(i)));
    }
    RenderSettings reference = settings;
    reference.moves = false;
    reference.denoise = Denoise::none;
    reference.seed = 5;
    const Image truth = colorOf(renderFilm(scene, walked(scene.cameras[0], 0.096F), reference, 512));
    for (int samples = 1; samples <= 64; ++samples) {
        renderer.renderSample();
        if ((samples & (samples - 1)) != 0) continue;
        const Film film = renderer.readFilm();
        EXPECT_LT(relMse(colorOf(film), truth), 1.05 * relMse(withoutAlpha(film.unfiltered), truth))
            << samples;
    }
}

}  // namespace
}  // namespace licht
