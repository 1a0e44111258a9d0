// The promise of --error: the picture is as right as was asked, and even samples keep it sooner.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <iostream>

#include "licht/film/error_estimate.h"
#include "licht/measure/metrics.h"
#include "licht/measure/statistics.h"
#include "licht/render/renderer.h"
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
    ErrorEstimate estimate(GetParam(), 0);
    ErrorSchedule schedule(kWanted, even);
    Advance advance;
    while (decideStop(rules_, advance) == Stop::none) {
        renderer.renderSample();
        advance.samples = renderer.samples();
        advance.seconds = 1e-6 * advance.samples;
        if (!schedule.due(advance.samples, advance.seconds)) continue;
        advance.error = estimate.look(renderer.readFilm());
        advance.error_samples = advance.samples;
        schedule.checked(advance, 0.0);
    }
    EXPECT_EQ(decideStop(rules_, advance), Stop::error);
    const double independent = std::pow(relativeError(reference()) / kWanted, 2.0) * reference().samples;
    if (even)
        EXPECT_LE(advance.samples, 0.5 * independent);
    else
        EXPECT_NEAR(advance.samples, independent, 0.05 * independent);
    expectKept(renderer.readFilm());
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
