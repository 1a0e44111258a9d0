// What is said of a picture's error, where samples are spread evenly: neither less than the error is, nor
// more than it was at half the samples.
#include "licht/film/error_estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <vector>

#include "licht/measure/metrics.h"
#include "licht/measure/statistics.h"
#include "licht/render/renderer.h"
#include "samples/scenes/builtin.h"
#include "support/gpu_test.h"
#include "support/render_test.h"

namespace licht {
namespace {

/// One gray pixel: a share of 1.01 of its mean's square is what errors are relative to.
Film grayFilm(std::uint32_t samples, float mean, float variance) {
    Film film;
    film.size = uvec2(1);
    film.samples = samples;
    film.mean = Image(1, 1, 4);
    film.mean.texels = {mean, mean, mean, 1.0F};
    film.variance = Image(1, 1, 3);
    film.variance.texels = {variance, variance, variance};
    return film;
}

double moved(double from, double to) {
    return (to - from) * (to - from) / (1.01 * to * to);
}

TEST(ErrorEstimate, IsHowFarTheLastDoublingMovedThePicture) {
    ErrorEstimate estimate(Sequence::sobol, 0);
    const Film four = grayFilm(4, 1.0F, 0.5F), eight = grayFilm(8, 1.5F, 0.25F);
    EXPECT_EQ(estimate.look(four), relativeError(four)) << "nothing is known but the variance";
    EXPECT_EQ(estimate.look(eight), relativeError(eight)) << "one doubling may have gone well by chance";
    EXPECT_NEAR(estimate.look(grayFilm(16, 1.25F, 0.125F)), std::sqrt(moved(1.5, 1.25)), 1e-6);
    // 24 are 16 and 8: of 8 the doubling before 4 was not seen, so they count as independent.
    const Film more = grayFilm(24, 1.25F, 0.1F);
    const double eight_of_24 = std::pow(relativeError(more), 2.0) * 8.0 / 24.0;
    EXPECT_NEAR(estimate.look(more), std::sqrt(moved(1.5, 1.25) * 4.0 / 9.0 + eight_of_24), 1e-6);
    // A picture that stands still by chance has a quarter of the error before.
    EXPECT_NEAR(estimate.look(grayFilm(32, 1.25F, 0.05F)), std::sqrt(moved(1.5, 1.25) / 4.0), 1e-6);
    // 48 are 32 and 16, both seen.
    EXPECT_NEAR(estimate.look(grayFilm(48, 1.25F, 0.05F)),
                std::sqrt(moved(1.5, 1.25) * (0.25 * 4.0 / 9.0 + 1.0 / 9.0)), 1e-6);
}

TEST(ErrorEstimate, IsThatOfIndependentSamplesWhereNothingElseIsKnown) {
    const auto shrinking = [](std::uint32_t n) {
        const float share = 1.0F / static_cast<float>(n);
        return grayFilm(n, 1.0F + share, share);
    };
    const auto last = [&](Sequence sampler, std::uint32_t first_sample,
                          const std::vector<std::uint32_t>& seen) {
        ErrorEstimate estimate(sampler, first_sample);
        double error = 0.0;
        for (const std::uint32_t n : seen) error = estimate.look(shrinking(n));
        return error;
    };
    const double plain = relativeError(shrinking(32));
    EXPECT_EQ(last(Sequence::random, 0, {8, 16, 32}), plain);
    EXPECT_EQ(last(Sequence::sobol, 0, {4, 8, 32}), plain) << "16 were not seen";
    EXPECT_EQ(last(Sequence::sobol, 16, {8, 16, 32}), plain) << "16 to 47 are not a block";
    EXPECT_LT(last(Sequence::sobol, 0, {8, 16, 32}), 0.2 * plain);
    EXPECT_LT(last(Sequence::sobol, 32, {8, 16, 32}), 0.2 * plain);
    EXPECT_EQ(ErrorEstimate(Sequence::sobol, 0).look(grayFilm(1, 1.0F, 0.0F)), -1.0);
}

/// By value: of each pixel, mean over channels, relative to the reference as relMSE is.
std::vector<double> squaredDifference(const Film& a, const Film& b, const Film& reference) {
    double picture_mean = 0.0;
    for (std::size_t c = 0; c < 3; ++c)
        picture_mean += pictureMean(reference, static_cast<int>(c)).mean / 3.0;
    std::vector<double> result(a.mean.texels.size() / 4);
    for (std::size_t i = 0; i < result.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t at = 4 * i + c;
            const double d = static_cast<double>(a.mean.texels[at]) - static_cast<double>(b.mean.texels[at]);
            result[i] +=
                relativeSquare(d * d, static_cast<double>(reference.mean.texels[at]), picture_mean) / 3.0;
        }
    return result;
}

/// Mean over pixels of a - share * b, which must be positive but for what chance does to it. Pixels are
/// independent but for the places in them that all share, which cost little in these pictures.
void expectAtLeast(const std::vector<double>& a, double share, const std::vector<double>& b,
                   const std::string& what) {
    RunningStatistics difference;
    for (std::size_t i = 0; i < a.size(); ++i) difference.add(a[i] - share * b[i]);
    EXPECT_GE(difference.mean(), -4.5 * std::sqrt(difference.varianceOfMean())) << what;
}

struct Pictured {
    std::string name;
    Scene scene;
    Camera camera;
    std::uint32_t bounces;
    DirectLight direct;
};

// E (M(2n) - M(n))^2 = V(n) - V(2n): at least V(2n), if doubling the samples at least halves their variance,
// and at most V(n). The reference's own error is independent of the picture's, and with 8 times the samples
// at most an eighth of its square.
TEST(ErrorEstimate, LiesBetweenTheErrorAndThatOfHalfTheSamples) {
    const Scene cornell = *makeBuiltinScene("cornell");
    const std::vector<Pictured> pictures = {{"floor", litFloor(), litFloorCamera(), 1, DirectLight::mis},
                                            {"smooth", litFloor(), litFloorCamera(), 1, DirectLight::area},
                                            {"cornell", cornell, cornell.cameras[0], 8, DirectLight::mis}};
    for (const Pictured& p : pictures) {
        RenderSettings settings;
        settings.size = uvec2(40);
        settings.bounces = p.bounces;
        settings.direct = p.direct;
        settings.seed = 1;
        const std::uint32_t most = p.name == "cornell" ? 32 : 64;
        const Film reference = renderFilm(p.scene, p.camera, settings, 8 * most);
        settings.seed = 0;
        for (const Sequence sampler : {Sequence::random, Sequence::sobol, Sequence::blue}) {
            settings.sampler = sampler;
            Renderer renderer(gpu::testDevice(), p.scene, p.camera, settings);
            ErrorEstimate estimate(sampler, 0);
            Film before;
            for (std::uint32_t n = 4; n <= most; n *= 2) {
                while (renderer.samples() < n) renderer.renderSample();
                const Film film = renderer.readFilm();
                const double estimated = estimate.look(film);
                if (n >= 16) {
                    const auto error = squaredDifference(film, reference, reference);
                    const auto half = squaredDifference(before, reference, reference);
                    const auto change = squaredDifference(film, before, reference);
                    const std::string what =
                        p.name + " " + std::to_string(static_cast<int>(sampler)) + " " + std::to_string(n);
                    expectAtLeast(change, 8.0 / 9.0, error, what + " too low");
                    expectAtLeast(half, 1.0, change, what + " too high");
                    const double found = std::sqrt(relMse(colorOf(film), colorOf(reference)));
                    std::cout << what << ": " << estimated / found << " of the error, as if independent "
                              << relativeError(film) / found << '\n';
                }
                before = film;
            }
        }
    }
}

}  // namespace
}  // namespace licht
