// The filter takes noise and keeps light, knows how wrong it is, and gives way to the mean as that converges.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <utility>

#include "licht/film/error_estimate.h"
#include "licht/measure/metrics.h"
#include "licht/render/renderer.h"
#include "samples/scenes/builtin.h"
#include "support/gpu_test.h"
#include "support/render_test.h"

namespace licht {
namespace {

RenderSettings plain(uvec2 size) {
    RenderSettings settings;
    settings.size = size;
    return settings;
}

RenderSettings filtering(uvec2 size) {
    RenderSettings settings = plain(size);
    settings.denoise = Denoise::spatiotemporal;
    return settings;
}

Film builtinFilm(const char* name, const RenderSettings& settings, std::uint32_t samples) {
    const Scene scene = *makeBuiltinScene(name);
    return renderFilm(scene, scene.cameras[0], settings, samples);
}

/// Beside which squared errors are told: two pictures of other samples, whose difference tells their own.
class Reference {
public:
    Reference(const char* name, RenderSettings settings, std::uint32_t samples) {
        settings.denoise = Denoise::none;
        settings.seed = 77;
        const Image one = colorOf(builtinFilm(name, settings, samples));
        settings.seed = 78;
        mean_ = colorOf(builtinFilm(name, settings, samples));
        for (std::size_t i = 0; i < mean_.texels.size(); ++i)
            mean_.texels[i] = 0.5F * (mean_.texels[i] + one.texels[i]);
        squared_error_ = relMse(one, mean_);  // a quarter of the difference's square
    }
    [[nodiscard]] double squaredErrorOf(const Image& picture) const {
        return relMse(picture, mean_) - squared_error_;
    }
    [[nodiscard]] const Image& mean() const { return mean_; }

private:
    Image mean_;
    double squared_error_ = 0.0;
};

// What the project asks of it: 12 times less squared error at 16 samples, 5 times at 64.
TEST(Denoise, TakesNoiseAndKeepsLight) {
    constexpr uvec2 kSize(256, 256);
    const Reference reference("cornell", plain(kSize), 64);
    const double mean = channelMeans(reference.mean())[0];
    for (const auto& [samples, gain] : {std::pair{4U, 12.0}, {16U, 12.0}, {64U, 5.0}}) {
        const Film raw = builtinFilm("cornell", plain(kSize), samples);
        const Film filtered = builtinFilm("cornell", filtering(kSize), samples);
        EXPECT_LT(gain * reference.squaredErrorOf(colorOf(filtered)), reference.squaredErrorOf(colorOf(raw)))
            << samples;
        // The light stays: no farther off than the mean of the samples, and a hundredth.
        const double off = channelMeans(withoutAlpha(filtered.unfiltered))[0] - mean;
        EXPECT_NEAR(channelMeans(colorOf(filtered))[0] - mean, off, 0.01 * mean) << samples;
    }
}

class DenoiseError : public testing::TestWithParam<const char*> {};

TEST_P(DenoiseError, IsKnown) {
    constexpr uvec2 kSize(160, 120);
    const Reference reference(GetParam(), plain(kSize), 128);
    for (const std::uint32_t samples : {4U, 16U, 64U}) {
        const Film film = builtinFilm(GetParam(), filtering(kSize), samples);
        const double squared = reference.squaredErrorOf(colorOf(film));
        ASSERT_GT(squared, 0.0);
        const double ratio = relativeError(film) / std::sqrt(squared);
        EXPECT_GT(ratio, 0.8) << samples;
        EXPECT_LT(ratio, 1.5) << samples;
    }
}

INSTANTIATE_TEST_SUITE_P(Builtin, DenoiseError, testing::Values("cornell", "lamps"),
                         [](const auto& scene) { return std::string(scene.param); });

// Mirrors are the worst for it: neighbours see other things.
TEST(Denoise, IsNeverWorseThanTheMeanOfItsSamples) {
    constexpr uvec2 kSize(48, 27);
    const Reference reference("spheres", plain(kSize), 256);
    const Scene scene = *makeBuiltinScene("spheres");
    Renderer renderer(gpu::testDevice(), scene, scene.cameras[0], filtering(kSize));
    for (std::uint32_t samples = 1; samples <= 128; ++samples) {
        renderer.renderSample();
        if ((samples & (samples - 1)) != 0) continue;
        const Film film = renderer.readFilm();
        ASSERT_FALSE(film.unfiltered.texels.empty());
        EXPECT_LE(reference.squaredErrorOf(colorOf(film)),
                  reference.squaredErrorOf(withoutAlpha(film.unfiltered)))
            << samples;
    }
}

// Its share falls where it is biased: with 16 times the samples the squared error falls by 4 at least.
TEST(Denoise, Converges) {
    constexpr uvec2 kSize(48, 27);
    const Reference reference("lamps", plain(kSize), 512);
    const double few = reference.squaredErrorOf(colorOf(builtinFilm("lamps", filtering(kSize), 16)));
    const double many = reference.squaredErrorOf(colorOf(builtinFilm("lamps", filtering(kSize), 256)));
    EXPECT_LT(4.0 * many, few);
}

// Its mean is that of other samples of the same picture.
TEST(Denoise, TheSamplesOfBothHalvesAreOfThePicture) {
    constexpr uvec2 kSize(64, 36);
    RenderSettings settings = plain(kSize);
    settings.sampler = Sequence::random;
    Film reference = builtinFilm("cornell", settings, 64);
    settings.denoise = Denoise::spatiotemporal;
    Film halves = builtinFilm("cornell", settings, 64);
    halves.mean = halves.unfiltered;
    halves.variance = reference.variance;
    expectSamePicture(halves, reference, "denoise_halves");
}

// The sums of the kernels are in another order, so a rounding may differ, and what follows from it.
TEST(Denoise, KernelAndQueuesFilterAlike) {
    RenderSettings settings = filtering(uvec2(48, 27));
    const Film kernel = builtinFilm("gallery", settings, 4);
    settings.queues = true;
    const Film queues = builtinFilm("gallery", settings, 4);
    EXPECT_LT(relMse(colorOf(queues), colorOf(kernel)), 1e-8);
    EXPECT_GT(relMse(withoutAlpha(kernel.unfiltered), colorOf(kernel)), 1e-3) << "nothing was filtered";
}

TEST(Denoise, LeavesAloneWhatComesStraightToTheCamera) {
    const Film film = builtinFilm("empty", filtering(uvec2(24, 16)), 4);
    ASSERT_FALSE(film.unfiltered.texels.empty());
    EXPECT_EQ(std::memcmp(film.mean.texels.data(), film.unfiltered.texels.data(),
                          film.mean.texels.size() * sizeof(float)),
              0);
}

// A renderer that is read twice, or moved, filters what it shows.
TEST(Denoise, FollowsTheCamera) {
    const Scene scene = *makeBuiltinScene("cornell");
    const RenderSettings settings = filtering(uvec2(32, 32));
    Camera there = scene.cameras[0];
    there.world_from_view[3] += vec4(0.1F, 0.0F, 0.0F, 0.0F);
    Renderer moved(gpu::testDevice(), scene, scene.cameras[0], settings);
    for (int i = 0; i < 4; ++i) moved.renderSample();
    EXPECT_EQ(moved.readFilm().mean.texels, moved.readFilm().mean.texels);
    moved.setCamera(there);
    for (int i = 0; i < 4; ++i) moved.renderSample();
    EXPECT_EQ(moved.readFilm().mean.texels, renderFilm(scene, there, settings, 4).mean.texels);
}

}  // namespace
}  // namespace licht
