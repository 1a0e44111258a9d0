#include "licht/render/renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <set>

#include "licht/render/pass_list.h"
#include "support/gpu_test.h"
#include "support/render_test.h"

namespace licht {
namespace {

bool identical(const Image& a, const Image& b) {
    return a.width == b.width && a.height == b.height && a.texels.size() == b.texels.size() &&
           std::memcmp(a.texels.data(), b.texels.data(), a.texels.size() * sizeof(float)) == 0;
}

void expectSameBits(const Film& a, const Film& b) {
    EXPECT_EQ(a.samples, b.samples);
    EXPECT_TRUE(identical(a.mean, b.mean));
    EXPECT_TRUE(identical(a.variance, b.variance));
    EXPECT_TRUE(identical(a.layer(LayerId::albedo), b.layer(LayerId::albedo)));
    EXPECT_TRUE(identical(a.layer(LayerId::normal), b.layer(LayerId::normal)));
    EXPECT_TRUE(identical(a.layer(LayerId::depth), b.layer(LayerId::depth)));
    EXPECT_TRUE(identical(a.layer(LayerId::motion), b.layer(LayerId::motion)));
    ASSERT_EQ(a.orders.size(), b.orders.size());
    for (std::size_t i = 0; i < a.orders.size(); ++i) EXPECT_TRUE(identical(a.orders[i], b.orders[i])) << i;
}

struct Kind {
    const char* name;
    bool queues;
    bool orders;
    bool adaptive;
};

RenderSettings settingsOf(const Kind& kind, uvec2 size) {
    RenderSettings settings;
    settings.size = size;
    settings.bounces = 3;
    settings.queues = kind.queues;
    settings.orders = kind.orders;
    settings.adaptive = kind.adaptive;
    settings.layers = {LayerId::albedo, LayerId::normal, LayerId::depth, LayerId::motion};
    return settings;
}

void draw(Renderer& renderer, const Kind& kind, int samples) {
    if (!kind.adaptive) {
        for (int i = 0; i < samples; ++i) renderer.renderSample();
        return;
    }
    renderer.beginRound(static_cast<std::uint32_t>(samples));
    while (!renderer.roundDone()) renderer.renderSample();
    renderer.endRound();
}

Camera movedCamera(const Camera& camera) {
    Camera moved = camera;
    moved.world_from_view[3] += vec4(0.05F, 0.02F, 0.0F, 0.0F);
    return moved;
}

class Renderers : public testing::TestWithParam<Kind> {};

TEST_P(Renderers, ResizingCompilesNothingAndDrawsWhatANewOneDraws) {
    gpu::Device& device = gpu::testDevice();
    const Scene scene = litFloor();
    Renderer resized(device, scene, litFloorCamera(), settingsOf(GetParam(), {24, 40}));
    draw(resized, GetParam(), 2);
    const std::uint64_t compiled = device.compiledPrograms();
    EXPECT_GT(compiled, 0U);
    resized.resize({40, 24});
    EXPECT_EQ(device.compiledPrograms(), compiled);
    draw(resized, GetParam(), 3);
    EXPECT_EQ(device.compiledPrograms(), compiled);
    Renderer fresh(device, scene, litFloorCamera(), settingsOf(GetParam(), {40, 24}));
    draw(fresh, GetParam(), 3);
    expectSameBits(resized.readFilm(), fresh.readFilm());
}

// While frames that see the old one may be in flight.
TEST_P(Renderers, AMovedCameraDrawsWhatANewRendererDraws) {
    gpu::Device& device = gpu::testDevice();
    const Scene scene = litFloor();
    const RenderSettings settings = settingsOf(GetParam(), {40, 24});
    const Camera there = movedCamera(litFloorCamera());
    Renderer moved(device, scene, litFloorCamera(), settings);
    draw(moved, GetParam(), 2);
    moved.setCamera(there);
    EXPECT_EQ(moved.samples(), 0U);
    draw(moved, GetParam(), 3);
    Renderer fresh(device, scene, there, settings);
    draw(fresh, GetParam(), 3);
    expectSameBits(moved.readFilm(), fresh.readFilm());
}

INSTANTIATE_TEST_SUITE_P(All, Renderers,
                         testing::Values(Kind{"kernel", false, false, false},
                                         Kind{"queues", true, false, false},
                                         Kind{"kernelOrders", false, true, false},
                                         Kind{"queuesOrders", true, true, false},
                                         Kind{"queuesAdaptive", true, false, true}),
                         [](const auto& kind) { return std::string(kind.param.name); });

void expectMotion(const Film& film, vec2 pixels) {
    ASSERT_EQ(film.layer(LayerId::motion).channels, 2);
    for (std::size_t i = 0; i < film.layer(LayerId::motion).texels.size(); i += 2) {
        // Positions of some 1 m at 100 pixels a metre, in fp32.
        ASSERT_NEAR(film.layer(LayerId::motion).texels[i], pixels.x, pixels.x == 0.0F ? 0.0F : 1e-4F);
        ASSERT_NEAR(film.layer(LayerId::motion).texels[i + 1], pixels.y, pixels.y == 0.0F ? 0.0F : 1e-4F);
    }
}

// The floor fills the picture, whose 0.8 m are 40 pixels.
TEST(Motion, IsThatOfTheLastSample) {
    const Scene scene = litFloor();
    const Kind kind{"", false, false, false};
    const auto at = [](float x, float z) {
        Camera camera = litFloorCamera();
        camera.world_from_view[3] += vec4(x, 0.0F, z, 0.0F);
        return camera;
    };
    Renderer renderer(gpu::testDevice(), scene, at(0, 0), settingsOf(kind, {40, 40}));
    renderer.renderSample();
    expectMotion(renderer.readFilm(), vec2(0.0F));
    renderer.setCamera(at(0.1F, 0));
    renderer.renderSample();
    expectMotion(renderer.readFilm(), vec2(-5, 0));
    renderer.renderSample();
    expectMotion(renderer.readFilm(), vec2(0.0F));
    renderer.setCamera(at(0.2F, 0.1F));
    renderer.setCamera(at(0.1F, -0.05F));  // nothing was drawn between
    renderer.renderSample();
    expectMotion(renderer.readFilm(), vec2(0, 2.5F));
    renderer.setCamera(at(0.1F, -0.05F));  // rests
    renderer.renderSample();
    expectMotion(renderer.readFilm(), vec2(0.0F));
    renderer.setCamera(at(0, 0));
    renderer.resize({40, 40});
    renderer.renderSample();
    expectMotion(renderer.readFilm(), vec2(0.0F));
}

TEST(Passes, AreThoseOfTheList) {
    const Scene scene = litFloor();
    std::set<std::string> seen;
    std::set<std::string> listed;
    for (const PassInfo& pass : passList()) listed.insert(std::string(pass.name));
    for (const bool queues : {false, true}) {
        const Kind kind{"", queues, queues, false};
        RenderSettings settings = settingsOf(kind, {16, 16});
        settings.denoise = Denoise::spatiotemporal;
        settings.moves = settings.scene_moves = true;
        Renderer renderer(gpu::testDevice(), scene, litFloorCamera(), settings);
        renderer.renderSample();
        renderer.setScene(scene);
        renderer.setCamera(movedCamera(litFloorCamera()));  // so that there is a history
        renderer.renderSample();
        static_cast<void>(renderer.readDisplay(Tonemap::none, 0.0F));
        double following = 0.0;
        for (const auto& [name, time] : renderer.statistics().passes) {
            const std::string pass = name.substr(0, name.find_last_not_of("0123456789 ") + 1);
            EXPECT_EQ(listed.count(pass), 1U) << name;
            seen.insert(pass);
            if (pass.substr(0, 4) == "path") following += time.seconds;
        }
        EXPECT_DOUBLE_EQ(pathSeconds(renderer.statistics().passes), following);
    }
    EXPECT_EQ(seen, listed);
}

}  // namespace
}  // namespace licht
