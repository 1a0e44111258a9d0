// Scenes that change from frame to frame: history follows what moves, and goes where the light changed.
#include <gtest/gtest.h>

#include <cmath>
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
    settings.scene_moves = true;
    return settings;
}

Scene at(double seconds) {
    return *makeBuiltinScene("moving", 0, seconds);
}

void draw(Renderer& renderer, int samples) {
    for (int i = 0; i < samples; ++i) renderer.renderSample();
}

// A scene that is replaced by its equal has not changed: no path finds other light, so nothing is forgotten.
TEST(MovingScene, ItsEqualChangesNothing) {
    const Scene scene = at(0.0);
    const RenderSettings settings = moving(uvec2(160, 120), Denoise::temporal);
    Camera there = scene.cameras[0];
    there.world_from_view[3] += vec4(0.02F, 0.0F, 0.0F, 0.0F);
    Renderer renderer(gpu::testDevice(), scene, scene.cameras[0], settings);
    Renderer replaced(gpu::testDevice(), scene, scene.cameras[0], settings);
    for (Renderer* one : {&renderer, &replaced}) {
        draw(*one, 4);
        if (one == &replaced) one->setScene(at(0.0));
        one->setCamera(there);
        draw(*one, 1);
    }
    EXPECT_EQ(replaced.readFilm().mean.texels, renderer.readFilm().mean.texels);
}

// Other surfaces are another scene, and a cut is a fresh start.
TEST(MovingScene, AnotherSceneIsAFreshStart) {
    const Scene room = at(0.0);
    const Scene cornell = *makeBuiltinScene("cornell");
    const RenderSettings settings = moving(uvec2(32, 24), Denoise::spatiotemporal);
    Renderer renderer(gpu::testDevice(), room, room.cameras[0], settings);
    draw(renderer, 3);
    renderer.setScene(at(0.5), ViewChange::cut);
    draw(renderer, 2);
    const Film film = renderer.readFilm();
    Renderer fresh(gpu::testDevice(), room, room.cameras[0], settings);
    fresh.setScene(at(0.5), ViewChange::cut);
    draw(fresh, 2);
    EXPECT_EQ(film.mean.texels, fresh.readFilm().mean.texels);
    renderer.setScene(cornell);
    renderer.setCamera(cornell.cameras[0]);
    draw(renderer, 2);
    EXPECT_LT(
        relMse(colorOf(renderer.readFilm()), colorOf(renderFilm(cornell, cornell.cameras[0], settings, 2))),
        1e-10);
}

/// A board before a dark wall; the spot lights the board alone, whose place is x.
Scene slidingBoard(float x) {
    Scene scene;
    Material white;
    white.base_color = vec4(0.8F, 0.8F, 0.8F, 1.0F);
    white.metallic = 0.0F;
    white.specular = 0.0F;
    const std::uint32_t material = addMaterial(scene, white);
    place(scene,
          quadMesh("wall", material, vec3(-9, -9, -9), vec3(9, -9, -9), vec3(9, 9, -9), vec3(-9, 9, -9)));
    place(scene, quadMesh("board", material, vec3(-1, -1, 0), vec3(1, -1, 0), vec3(1, 1, 0), vec3(-1, 1, 0)),
          moved(vec3(x, 0.0F, -5.0F)));
    PunctualLight light;
    light.kind = PunctualLight::Kind::spot;
    light.intensity = vec3(100.0F);
    light.position = vec3(x, 0.0F, 0.0F);
    light.direction = vec3(0.0F, 0.0F, -1.0F);
    light.inner_cone = 0.05F;
    light.outer_cone = 0.15F;
    scene.lights.push_back(light);
    Camera camera;
    camera.y_fov = 0.5F;
    scene.cameras.push_back(camera);
    return scene;
}

// The board carries its light along: by its previous place the history finds it, so no light is lost or left.
TEST(MovingScene, HistoryFollowsWhatMoves) {
    RenderSettings settings = moving(uvec2(64, 48), Denoise::temporal);
    settings.bounces = 1;
    const auto placeAt = [](int frame) { return -0.5F + 0.03F * static_cast<float>(frame); };
    const Scene first = slidingBoard(placeAt(0));
    Renderer renderer(gpu::testDevice(), first, first.cameras[0], settings);
    constexpr int kFrames = 16;
    renderer.renderSample();
    for (int frame = 1; frame < kFrames; ++frame) {
        renderer.setScene(slidingBoard(placeAt(frame)));
        renderer.renderSample();
    }
    const Image moved_picture = colorOf(renderer.readFilm());
    const Scene last = slidingBoard(placeAt(kFrames - 1));
    RenderSettings plain = settings;
    plain.moves = plain.scene_moves = false;
    plain.denoise = Denoise::none;
    const Image truth = colorOf(renderFilm(last, last.cameras[0], plain, 64));
    // Light that stayed behind, or was lost, would be of the order of the light itself; what resampling blurs
    // at the spot's rim is a small share of it.
    EXPECT_LT(relMse(moved_picture, truth), 2e-3);
    EXPECT_NEAR(channelMeans(moved_picture)[0] / channelMeans(truth)[0], 1.0, 0.01);
}

// Once the light is dimmed, the picture is as right as if it had begun then, after eight frames at most.
TEST(MovingScene, LightThatChangesIsForgottenSoon) {
    constexpr uvec2 kSize(64, 64);
    constexpr std::uint32_t kBefore = 16;
    constexpr int kFrames = 8;
    const Scene bright = *makeBuiltinScene("cornell");
    Scene dim = bright;
    for (Material& material : dim.materials) material.emission *= 0.3F;
    RenderSettings plain = moving(kSize, Denoise::none);
    plain.moves = plain.scene_moves = false;
    plain.seed = 9;
    const Image truth = colorOf(renderFilm(dim, dim.cameras[0], plain, 512));
    for (const Denoise denoise : {Denoise::temporal, Denoise::spatiotemporal}) {
        RenderSettings settings = moving(kSize, denoise);
        Renderer renderer(gpu::testDevice(), bright, bright.cameras[0], settings);
        draw(renderer, kBefore);
        renderer.setScene(dim);
        draw(renderer, kFrames);
        settings.first_sample = kBefore;  // the same noise
        const Film fresh = renderFilm(dim, dim.cameras[0], settings, kFrames);
        EXPECT_LT(relMse(colorOf(renderer.readFilm()), truth), 1.1 * relMse(colorOf(fresh), truth))
            << nameOf(denoise);
    }
}

// One frame of light that no float can square is counted, and gone with the next.
TEST(MovingScene, APoisonedFrameIsGoneWithTheNext) {
    const Scene scene = *makeBuiltinScene("cornell");
    Scene poisoned = scene;
    for (Material& material : poisoned.materials) material.emission *= 1e36F;
    for (const Denoise denoise : {Denoise::temporal, Denoise::spatiotemporal}) {
        Renderer renderer(gpu::testDevice(), scene, scene.cameras[0], moving(uvec2(24, 24), denoise));
        draw(renderer, 4);
        renderer.setScene(poisoned);
        draw(renderer, 1);
        renderer.finish();
        EXPECT_GT(renderer.statistics().nonfinite_samples, 0U);
        renderer.setScene(scene);
        draw(renderer, 1);
        for (const float value : renderer.readFilm().mean.texels) {
            ASSERT_TRUE(std::isfinite(value)) << nameOf(denoise);
            ASSERT_LT(value, 1e4F) << nameOf(denoise);  // the lamp has 17; a path may find it some times over
        }
    }
}

// What everything moves does to the whole.
TEST(MovingScene, NoiseGoes) {
    std::vector<PathFrame> path;
    const Scene first = at(0.0);
    for (int i = 0; i < 10; ++i)
        path.push_back({first.cameras[0], ViewChange::motion, [i] { return at(i / 24.0); }});
    RenderSettings settings;
    settings.size = uvec2(96, 72);
    const TemporalAccuracy accuracy = measureTemporal(gpu::testDevice(), first, path, settings, {1, 64});
    EXPECT_LT(3.0 * accuracy.modes[1].relMse(), accuracy.modes[0].relMse());
    EXPECT_LT(8.0 * accuracy.modes[2].relMse(), accuracy.modes[0].relMse());
    EXPECT_LT(accuracy.modes[1].ghost.value, 2.0 * accuracy.modes[1].ghost.standard_error);
}

}  // namespace
}  // namespace licht
