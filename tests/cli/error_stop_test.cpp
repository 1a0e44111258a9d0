// The promise of --error: the picture is as right as was asked, and even samples keep it sooner.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <iostream>

#include "licht/film/error_estimate.h"
#include "licht/measure/metrics.h"
#include "licht/measure/statistics.h"
#include "licht/render/renderer.h"
#include "licht/run/accumulation.h"
#include "licht/run/render_loop.h"
#include "support/gpu_test.h"
#include "support/render_test.h"

namespace licht {
namespace {

constexpr double kWanted = 0.01;

class ErrorStop : public testing::TestWithParam<Sequence> {
protected:
    ErrorStop() {
        settings_.size = uvec2(48);
        settings_.bounces = 1;
        settings_.sampler = GetParam();
        rules_.samples = 4096;
        rules_.error = kWanted;
    }

    static const Film& reference() {
        static const Film film = [] {
            RenderSettings settings;
            settings.size = uvec2(48);
            settings.bounces = 1;
            settings.seed = 1;
            return renderFilm(litFloor(), litFloorCamera(), settings, 1024);
        }();
        return film;
    }

    // The square of the true error is a mean over pixels, known to its own spread.
    void expectKept(const Film& film) {
        const double mean = pictureMean(reference(), 1).mean;
        RunningStatistics squares;
        for (std::size_t i = 1; i < reference().mean.texels.size(); i += 4) {
            const auto b = static_cast<double>(reference().mean.texels[i]);
            const double d = static_cast<double>(film.mean.texels[i]) - b;
            squares.add(relativeSquare(d * d, b, mean));
        }
        EXPECT_LE(squares.mean(), kWanted * kWanted + 4.5 * std::sqrt(squares.varianceOfMean()));
        std::cout << film.samples << " samples, error " << std::sqrt(squares.mean()) << " of " << kWanted
                  << '\n';
    }

    RenderSettings settings_;
    StopRules rules_;
};

TEST_P(ErrorStop, KeepsWhatIsPromised) {
    Renderer renderer(gpu::testDevice(), litFloor(), litFloorCamera(), settings_);
    const LoopResult result = renderUntil(renderer, settings_, rules_);
    EXPECT_EQ(result.stopped_by, Stop::error);
    EXPECT_LE(result.error, kWanted);
    expectKept(result.film);
}

// By a clock on which looking at the picture costs nothing: in a small picture it is the most of the time.
// Independent samples have this error after sigma^2 / kWanted^2 of them, where sigma is known from the
// reference's own variances. From 64 samples of 2304 pixels that is forecast to about 1 %.
TEST_P(ErrorStop, ComesSoonerWithEvenSamples) {
    Renderer renderer(gpu::testDevice(), litFloor(), litFloorCamera(), settings_);
    const bool even = GetParam() != Sequence::random;
    Accumulation picture(renderer, settings_, kWanted, [&renderer] { return 1e-6 * renderer.samples(); });
    while (decideStop(rules_, picture.advance()) == Stop::none) {
        renderer.renderSample();
        picture.look();
    }
    const Advance& advance = picture.advance();
    EXPECT_EQ(decideStop(rules_, advance), Stop::error);
    const double independent = std::pow(relativeError(reference()) / kWanted, 2.0) * reference().samples;
    if (even)
        EXPECT_LE(advance.samples, 0.5 * independent);
    else
        EXPECT_NEAR(advance.samples, independent, 0.05 * independent);
    expectKept(renderer.readFilm());
}

// As the viewer does when its camera moves.
TEST(Accumulation, ForgetsWhatWasBeforeARestart) {
    RenderSettings settings;
    settings.size = uvec2(16);
    settings.bounces = 1;
    Camera camera = litFloorCamera();
    Renderer renderer(gpu::testDevice(), litFloor(), camera, settings);
    double seconds = 0.0;
    Accumulation picture(renderer, settings, std::nullopt, [&seconds] { return seconds; });
    const auto draw = [&](std::uint32_t samples) {
        for (std::uint32_t i = 0; i < samples; ++i) {
            renderer.renderSample();
            seconds += 1.0;
            picture.look();
        }
    };
    draw(8);
    EXPECT_EQ(picture.advance().samples, 8U);
    EXPECT_EQ(picture.advance().seconds, 8.0);
    EXPECT_EQ(picture.advance().error_samples, 8U);
    EXPECT_GT(picture.advance().error, 0.0);

    camera.world_from_view = glm::translate(camera.world_from_view, vec3(0.0F, 0.0F, 0.5F));
    renderer.setCamera(camera);
    picture.restart();
    EXPECT_EQ(picture.advance().samples, 0U);
    EXPECT_LT(picture.advance().error, 0.0);
    draw(8);
    EXPECT_EQ(picture.advance().seconds, 8.0);
    const double seen = picture.advance().error;

    // The same error as of a picture that never was another.
    Renderer other(gpu::testDevice(), litFloor(), camera, settings);
    ErrorEstimate estimate(settings.sampler, settings.first_sample);
    double expected = -1.0;
    for (std::uint32_t i = 1; i <= 8; ++i) {
        other.renderSample();
        if (i >= 2) expected = estimate.look(other.readFilm());
    }
    EXPECT_EQ(seen, expected);
    EXPECT_EQ(picture.finish().samples, 8U);
}

INSTANTIATE_TEST_SUITE_P(Samplers, ErrorStop,
                         testing::Values(Sequence::random, Sequence::sobol, Sequence::blue),
                         [](const auto& instance) {
                             return instance.param == Sequence::random  ? "random"
                                    : instance.param == Sequence::sobol ? "sobol"
                                                                        : "blue";
                         });

}  // namespace
}  // namespace licht
