// The biased shortcuts: what they touch, and that what they take is accounted for.
#include <gtest/gtest.h>

#include <cstring>

#include "licht/film/orders.h"
#include "licht/render/renderer.h"
#include "samples/scenes/builtin.h"
#include "support/gpu_test.h"
#include "support/render_test.h"

namespace licht {
namespace {

RenderSettings small() {
    RenderSettings settings;
    settings.size = uvec2(48, 32);
    settings.bounces = 6;
    settings.sampler = Sequence::random;
    return settings;
}

bool identical(const Image& a, const Image& b) {
    return a.texels.size() == b.texels.size() &&
           std::memcmp(a.texels.data(), b.texels.data(), a.texels.size() * sizeof(float)) == 0;
}

// sum(kept) + sum(lost) = sum(raw) to 1e-5: the paths are the same, so the difference is rounding alone.
TEST(Clamp, KeptAndLostAreAll) {
    const std::vector<std::pair<const char*, bool>> cases{
        {"cornell", false}, {"cornell", true}, {"gallery", false}};
    for (const auto& [name, queues] : cases) {
        const Scene scene = *makeBuiltinScene(name);
        RenderSettings settings = small();
        settings.queues = queues;
        const Film raw = renderFilm(scene, scene.cameras[0], settings, 6);
        EXPECT_TRUE(raw.lost.texels.empty());
        settings.clamp = 0.05F;
        const Film clamped = renderFilm(scene, scene.cameras[0], settings, 6);
        double kept_sum = 0.0, lost_sum = 0.0, raw_sum = 0.0;
        for (std::size_t pixel = 0; pixel < 48 * 32; ++pixel) {
            for (std::size_t c = 0; c < 3; ++c) {
                const auto kept = static_cast<double>(clamped.mean.texels[4 * pixel + c]);
                const auto lost = static_cast<double>(clamped.lost.texels[3 * pixel + c]);
                const auto all = static_cast<double>(raw.mean.texels[4 * pixel + c]);
                ASSERT_NEAR(kept + lost, all, 1e-5 * all) << name << ", pixel " << pixel;
                ASSERT_GE(lost, 0.0);
                kept_sum += kept;
                lost_sum += lost;
                raw_sum += all;
            }
        }
        EXPECT_NEAR(kept_sum + lost_sum, raw_sum, 1e-5 * raw_sum);
        EXPECT_GT(lost_sum, 0.01 * raw_sum) << name << ": the test has nothing to tell";
    }
}

TEST(Clamp, LeavesEmissionAndDirectLightAlone) {
    const Scene scene = *makeBuiltinScene("cornell");
    RenderSettings settings = small();
    settings.orders = true;
    const Film raw = renderFilm(scene, scene.cameras[0], settings, 4);
    settings.clamp = 0.01F;
    const Film clamped = renderFilm(scene, scene.cameras[0], settings, 4);
    ASSERT_EQ(clamped.orders.size(), raw.orders.size()) << "the lost light is no order";
    EXPECT_TRUE(identical(raw.orders[0], clamped.orders[0]));
    EXPECT_TRUE(identical(raw.orders[1], clamped.orders[1]));
    EXPECT_FALSE(identical(raw.orders[2], clamped.orders[2]));
    // A sample adds at most a light sample and a scattered one to an order.
    for (const float value : clamped.orders[2].texels) EXPECT_LE(value, 2.0F * 0.01F * 1.000001F);
}

TEST(Clamp, AboveEverythingChangesNoBit) {
    const Scene scene = *makeBuiltinScene("gallery");
    RenderSettings settings = small();
    const Film raw = renderFilm(scene, scene.cameras[0], settings, 4);
    settings.clamp = 1e30F;
    const Film clamped = renderFilm(scene, scene.cameras[0], settings, 4);
    EXPECT_TRUE(identical(raw.mean, clamped.mean));
    for (const float value : clamped.lost.texels) ASSERT_EQ(value, 0.0F);
}

TEST(Clamp, ShareOfTheBatchesIsThatOfThePicture) {
    const Scene scene = *makeBuiltinScene("cornell");
    RenderSettings settings = small();
    settings.clamp = 0.05F;
    Renderer renderer(gpu::testDevice(), scene, scene.cameras[0], settings);
    for (int i = 0; i < 12; ++i) renderer.renderSample();
    const Film film = renderer.readFilm();
    glm::dvec3 kept(0.0), lost(0.0);
    for (std::size_t pixel = 0; pixel < 48 * 32; ++pixel) {
        for (int c = 0; c < 3; ++c) {
            kept[c] +=
                static_cast<double>(film.mean.texels[4 * pixel + static_cast<std::size_t>(c)]) / (48 * 32);
            lost[c] +=
                static_cast<double>(film.lost.texels[3 * pixel + static_cast<std::size_t>(c)]) / (48 * 32);
        }
    }
    const Estimated share = lostShare(renderer.lightBatches(), kept);
    EXPECT_NEAR(share.value, luminanceOf(lost) / luminanceOf(kept + lost), 1e-5);
    EXPECT_GT(share.standard_error, 0.0);
    EXPECT_LT(share.standard_error, share.value);
}

// Direct light leaves the first surface as it is; behind it narrow lobes become wider.
TEST(Regularise, TouchesOnlyWhatLiesBehindAScattering) {
    const Scene scene = *makeBuiltinScene("gallery");
    RenderSettings settings = small();
    settings.orders = true;
    settings.bounces = 3;
    const Film raw = renderFilm(scene, scene.cameras[0], settings, 4);
    settings.regularise = true;
    const Film wide = renderFilm(scene, scene.cameras[0], settings, 4);
    EXPECT_TRUE(identical(raw.orders[0], wide.orders[0]));
    EXPECT_TRUE(identical(raw.orders[1], wide.orders[1]));
    EXPECT_FALSE(identical(raw.orders[2], wide.orders[2]));
}

TEST(Regularise, ChangesNothingWhereNothingIsGlossy) {
    const Scene scene = *makeBuiltinScene("cornell");
    RenderSettings settings = small();
    const Film raw = renderFilm(scene, scene.cameras[0], settings, 4);
    settings.regularise = true;
    EXPECT_TRUE(identical(raw.mean, renderFilm(scene, scene.cameras[0], settings, 4).mean));
}

}  // namespace
}  // namespace licht
