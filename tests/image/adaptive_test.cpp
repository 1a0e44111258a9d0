// Samples where the noise is: how they are dealt out, that the mean stays right whatever happens, and what it
// brings.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <random>
#include <span>
#include <tuple>

#include "licht/film/adaptive_film.h"
#include "licht/film/error_estimate.h"
#include "licht/measure/metrics.h"
#include "licht/render/renderer.h"
#include "samples/scenes/assembly.h"
#include "samples/scenes/builtin.h"
#include "samples/scenes/shapes.h"
#include "support/gpu_test.h"
#include "support/render_test.h"

namespace licht {
namespace {

bool identical(const Image& a, const Image& b) {
    return a.texels.size() == b.texels.size() &&
           std::memcmp(a.texels.data(), b.texels.data(), a.texels.size() * sizeof(float)) == 0;
}

RenderSettings small(std::uint32_t seed) {
    RenderSettings settings;
    settings.size = uvec2(48, 40);
    settings.seed = seed;
    settings.sampler = Sequence::random;
    return settings;
}

Film renderRounds(const Scene& scene, RenderSettings settings, std::uint32_t samples) {
    settings.adaptive = true;
    Renderer renderer(gpu::testDevice(), scene, scene.cameras[0], settings);
    for (std::uint32_t done = 0; done < samples;) {
        const std::uint32_t budget = nextRound(done, samples, std::nullopt);
        renderer.beginRound(budget);
        while (!renderer.roundDone()) renderer.renderSample();
        renderer.endRound();
        done += budget;
    }
    EXPECT_EQ(renderer.samples(), samples);
    return renderer.readFilm();
}

/// A round on the host: every pixel of a tile sampled as planned from `draw(pixel)`.
template <typename Draw>
void foldRound(AdaptiveFilm& film, uvec2 size, std::uint32_t budget, Draw draw) {
    const std::vector<std::uint32_t> plan = film.plan(budget);
    const std::vector<std::uint32_t> counts = film.perPixel(plan);
    std::vector<vec4> mean(counts.size()), squares(counts.size());
    for (std::size_t pixel = 0; pixel < counts.size(); ++pixel) {
        std::vector<float> values(counts[pixel]);
        for (float& value : values) value = draw(pixel % size.x, pixel / size.x);
        float sum = 0.0F, deviations = 0.0F;
        for (const float value : values) sum += value;
        const float m = sum / static_cast<float>(values.size());
        for (const float value : values) deviations += (value - m) * (value - m);
        mean[pixel] = vec4(vec3(m), 1.0F);
        squares[pixel] = vec4(vec3(deviations), 0.0F);
    }
    film.fold(budget, plan, std::as_bytes(std::span(mean)), std::as_bytes(std::span(squares)));
}

TEST(Rounds, GrowAndEndWhereTheyShould) {
    EXPECT_EQ(nextRound(0, std::nullopt, std::nullopt), 8U);
    EXPECT_EQ(nextRound(8, std::nullopt, std::nullopt), 8U);
    EXPECT_EQ(nextRound(16, std::nullopt, std::nullopt), 16U);
    EXPECT_EQ(nextRound(4096, std::nullopt, std::nullopt), 64U);
    EXPECT_EQ(nextRound(0, 3U, std::nullopt), 3U);
    EXPECT_EQ(nextRound(16, 39U, std::nullopt), 23U) << "no crumbs are left";
    EXPECT_EQ(nextRound(40, 40U, std::nullopt), 0U);
    EXPECT_EQ(nextRound(0, std::nullopt, 0.2), 1U) << "one sample in any case";
    EXPECT_EQ(nextRound(16, std::nullopt, 5.7), 5U);
    EXPECT_EQ(nextRound(16, std::nullopt, 1.9), 0U);
    // Every count is reached exactly.
    for (std::uint32_t wanted = 1; wanted < 400; ++wanted) {
        std::uint32_t done = 0;
        while (const std::uint32_t budget = nextRound(done, wanted, std::nullopt)) done += budget;
        ASSERT_EQ(done, wanted);
    }
}

TEST(Plan, SpendsTheBudgetWithinItsBounds) {
    const uvec2 size(37, 21);  // tiles at the rims are smaller
    std::mt19937 random(1);
    std::normal_distribution<float> normal;
    AdaptiveFilm film(size);
    for (const std::uint32_t n : film.plan(8)) EXPECT_EQ(n, 8U) << "nothing is known before the first round";
    foldRound(film, size, 8, [&](std::size_t x, std::size_t y) {
        return 1.0F + (x < 12 && y < 12 ? 0.5F : 0.01F) * normal(random);
    });
    for (const std::uint32_t budget : {1U, 2U, 3U, 8U, 16U, 64U}) {
        const std::vector<std::uint32_t> plan = film.plan(budget);
        double spent = 0.0;
        for (std::size_t tile = 0; tile < plan.size(); ++tile) {
            spent += plan[tile] * film.tileShare(tile);
            EXPECT_GE(plan[tile], std::min(budget, 2U));
            EXPECT_GE(plan[tile] + 1.0, AdaptiveFilm::kUniformShare * budget);
            EXPECT_LE(plan[tile], AdaptiveFilm::kMostShare * budget);
        }
        // The last tile's rounding is left over: half a sample of it.
        EXPECT_NEAR(spent, budget, 0.5 * film.tileShare(plan.size() - 1) + 1e-9 * budget) << budget;
        if (budget >= 8) {
            EXPECT_GE(plan[0], 2 * plan[plan.size() - 1]) << "the noise is in the first tiles";
        }
    }
}

// One noisy tile cannot take everything: what it must not have is dealt out to all.
TEST(Plan, SpendsTheBudgetWhereNearlyNothingIsNoisy) {
    const uvec2 size(64, 64);
    std::mt19937 random(2);
    std::normal_distribution<float> normal;
    AdaptiveFilm film(size);
    foldRound(film, size, 8, [&](std::size_t x, std::size_t y) {
        return x < 8 && y < 8 ? 1.0F + 0.5F * normal(random) : 1.0F;
    });
    double spent = 0.0;
    const std::vector<std::uint32_t> plan = film.plan(16);
    for (std::size_t tile = 0; tile < plan.size(); ++tile) spent += plan[tile] * film.tileShare(tile);
    EXPECT_NEAR(spent, 16.0, 0.5 / 64.0);
    EXPECT_GE(plan[0], 4 * 16U);
    EXPECT_LT(plan[63], 16U);
}

// A picture that fools samplers who trust what they have seen: most tiles have met no bright event after the
// first round. Independent pictures, so the mean over them is normal.
TEST(AdaptiveFilm, IsUnbiasedWhereRareEventsFoolIt) {
    const uvec2 size(64, 64);
    constexpr double kPixels = 64 * 64;
    constexpr double kShare = 0.0005, kBright = 100.0, kDim = 0.1;
    constexpr double kExact = kShare * kBright + (1.0 - kShare) * kDim;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform;
    const auto draw = [&](std::size_t, std::size_t) {
        return static_cast<float>(uniform(random) < kShare ? kBright : kDim);
    };
    constexpr int kPictures = 100;
    double sum = 0.0, squares = 0.0, by_count = 0.0, variance = 0.0;
    for (int i = 0; i < kPictures; ++i) {
        AdaptiveFilm film(size);
        Film first;
        double naive = 0.0;  // what weights by a pixel's own counts would make of it
        for (const std::uint32_t budget : {8U, 24U}) {
            foldRound(film, size, budget, draw);
            if (first.samples == 0) first = film.film();
        }
        const Film done = film.film();
        double mean = 0.0, of_mean = 0.0;
        for (std::size_t pixel = 0; pixel < size.x * size.y; ++pixel) {
            mean += static_cast<double>(done.mean.texels[4 * pixel]) / kPixels;
            of_mean += static_cast<double>(done.variance.texels[3 * pixel]) / (kPixels * kPixels);
            const double n = static_cast<double>(done.counts.texels[pixel]);
            const double m1 = static_cast<double>(first.mean.texels[4 * pixel]);
            const double rest = (32.0 * static_cast<double>(done.mean.texels[4 * pixel]) - 8.0 * m1) / 24.0;
            naive += (8.0 * m1 + (n - 8.0) * rest) / n / kPixels;
        }
        sum += mean;
        squares += mean * mean;
        by_count += naive;
        variance += of_mean;
    }
    const double mean = sum / kPictures;
    const double spread = (squares / kPictures - mean * mean) * kPictures / (kPictures - 1);
    const double standard_error = std::sqrt(spread / kPictures);
    EXPECT_NEAR(mean, kExact, 4.5 * standard_error);
    // The estimated variance of a picture's mean is the spread of such means; its own error is that of a
    // variance from 100 values: a seventh.
    EXPECT_NEAR(variance / kPictures / spread, 1.0, 4.5 / 7.0);
    EXPECT_LT(by_count / kPictures, kExact - 4.5 * standard_error)
        << "weights by count are not biased here: the test does not tell the two apart";
}

TEST(Adaptive, FirstRoundIsTheUniformPicture) {
    const Scene scene = *makeBuiltinScene("cornell");
    const Film uniform = renderFilm(scene, scene.cameras[0], small(1), 8);
    const Film rounds = renderRounds(scene, small(1), 8);
    EXPECT_TRUE(identical(uniform.mean, rounds.mean));
    EXPECT_TRUE(identical(uniform.variance, rounds.variance));
}

/// The counts of each pixel and the whole picture at the end of every round.
std::vector<Film> eachRound(const Scene& scene, RenderSettings settings,
                            std::span<const std::uint32_t> budgets) {
    settings.adaptive = true;
    Renderer renderer(gpu::testDevice(), scene, scene.cameras[0], settings);
    std::vector<Film> films;
    for (const std::uint32_t budget : budgets) {
        renderer.beginRound(budget);
        while (!renderer.roundDone()) renderer.renderSample();
        renderer.endRound();
        films.push_back(renderer.readFilm());
    }
    return films;
}

/// Sums over the first samples of each pixel: of k samples at k.
std::vector<std::vector<double>> firstSums(const Scene& scene, const RenderSettings& settings,
                                           std::uint32_t samples) {
    Renderer renderer(gpu::testDevice(), scene, scene.cameras[0], settings);
    std::vector<std::vector<double>> sums(1);
    for (std::uint32_t k = 1; k <= samples; ++k) {
        renderer.renderSample();
        const Image mean = renderer.readFilm().mean;
        std::vector<double>& sum = sums.emplace_back();
        for (const float value : mean.texels)
            sum.push_back(static_cast<double>(k) * static_cast<double>(value));
    }
    return sums;
}

/// A floor that fills the picture below a black sky with two bright spots. What a sample of it is follows
/// from the sample's numbers alone, wherever in its pixel the camera's ray goes through.
Scene spottedFloor() {
    Scene scene;
    const std::uint32_t white = addMaterial(scene, matte("white", vec3(0.8F)));
    place(scene,
          quadMesh("floor", white, vec3(-50, 0, 50), vec3(50, 0, 50), vec3(50, 0, -50), vec3(-50, 0, -50)));
    scene.environment = Environment{"sky", Image(16, 8, 3)};
    for (const auto& [x, y, radiance] : {std::tuple(3, 2, 1.0F), std::tuple(9, 0, 40.0F)})
        for (int c = 0; c < 3; ++c) scene.environment->radiance.at(x, y, c) = radiance;
    scene.cameras.push_back(lookingCamera("aslant", vec3(0.0F, 5.0F, 5.0F), vec3(0.0F), 0.5F));
    return scene;
}

// Each round goes on with the samples that a pixel has not drawn yet, however many its tile had: no gaps, no
// repetitions. So every round's mean follows from sums over the first samples of a uniform picture.
TEST(Adaptive, SamplesOfAPixelAreNumberedWithoutGaps) {
    const Scene scene = spottedFloor();
    RenderSettings settings = small(2);
    settings.direct = DirectLight::hemisphere;
    constexpr std::array<std::uint32_t, 3> kBudgets{8, 8, 16};
    const std::vector<Film> films = eachRound(scene, settings, kBudgets);
    const std::vector<float>& last = films.back().counts.texels;
    const auto most = static_cast<std::uint32_t>(*std::max_element(last.begin(), last.end()));
    ASSERT_LT(most, 300U);
    const std::vector<std::vector<double>> sums = firstSums(scene, settings, most);
    // A sum is k times a mean that was rounded to a float.
    constexpr double kUnit = 6e-8;
    std::size_t uneven = 0;
    for (std::size_t pixel = 0; pixel < last.size(); ++pixel) {
        const std::size_t first_round = static_cast<std::size_t>(films[0].counts.texels[pixel]);
        const std::size_t second_round = static_cast<std::size_t>(films[1].counts.texels[pixel]);
        uneven += second_round != 16 ? 1 : 0;
        ASSERT_EQ(first_round, 8U);
        for (std::size_t i = 4 * pixel; i < 4 * pixel + 3; ++i) {
            double exact = 0.0, bound = 0.0;
            std::size_t before = 0;
            for (std::size_t round = 0; round < films.size(); ++round) {
                const auto now = static_cast<std::size_t>(films[round].counts.texels[pixel]);
                ASSERT_GT(now, before);
                const double weight = kBudgets[round] / 32.0 / static_cast<double>(now - before);
                const double sum_before = before > 0 ? sums[before][i] : 0.0;
                exact += weight * (sums[now][i] - sum_before);
                bound += kUnit * weight * (sums[now][i] + sum_before);
                before = now;
            }
            ASSERT_NEAR(films.back().mean.texels[i], exact, bound + 4 * kUnit * exact) << pixel;
        }
    }
    EXPECT_GT(uneven, 0U) << "nothing was adapted";
}

TEST(Adaptive, IsTheSameInKernelAndQueues) {
    const Scene scene = *makeBuiltinScene("cornell");
    RenderSettings queues = small(3);
    queues.queues = true;
    const Film a = renderRounds(scene, small(3), 32);
    const Film b = renderRounds(scene, queues, 32);
    EXPECT_TRUE(identical(a.mean, b.mean));
    EXPECT_TRUE(identical(a.counts, b.counts));
}

TEST(Adaptive, ShowsTheWholePictureAndNotTheLastRound) {
    const Scene scene = *makeBuiltinScene("furnace");
    RenderSettings settings = small(4);
    settings.adaptive = true;
    settings.roulette_start = settings.bounces;  // a path ended by chance is noise
    Renderer renderer(gpu::testDevice(), scene, scene.cameras[0], settings);
    renderer.beginRound(2);
    while (!renderer.roundDone()) renderer.renderSample();
    renderer.endRound();
    const Image display = renderer.readDisplay(Tonemap::none, -1.0F);
    const Film film = renderer.readFilm();
    // Half of L = 1 - 2^-9, through the sRGB curve: 0.7347; 8 bits.
    for (std::size_t i = 0; i < display.texels.size(); i += 4)
        ASSERT_NEAR(display.texels[i], 0.7347F, 0.5F / 255.0F + 1e-3F);
    EXPECT_EQ(film.samples, 2U);
}

// With orders and a clamp: means by rounds, too.
TEST(Adaptive, OrdersSumToThePicture) {
    const Scene scene = *makeBuiltinScene("cornell");
    RenderSettings settings = small(5);
    settings.orders = true;
    settings.bounces = 4;
    const Film film = renderRounds(scene, settings, 32);
    for (std::size_t pixel = 0; pixel < 48 * 40; ++pixel) {
        for (std::size_t c = 0; c < 3; ++c) {
            double sum = 0.0;
            for (const Image& order : film.orders) sum += static_cast<double>(order.texels[3 * pixel + c]);
            const auto mean = static_cast<double>(film.mean.texels[4 * pixel + c]);
            // At most 64 samples of two terms are added in fp32.
            ASSERT_NEAR(sum, mean, 128 * 6e-8 * mean) << pixel;
        }
    }
}

// A small lamp that only scattering finds: rare and bright. The reference finds it by light sampling.
TEST(Adaptive, HasTheMeanOfUniformSampling) {
    const Scene scene = *makeBuiltinScene("cornell");
    RenderSettings settings = small(0);
    settings.bounces = 2;
    const Film reference = renderFilm(scene, scene.cameras[0], settings, 256);
    const PictureMean known = pictureMean(reference, 1);
    settings.direct = DirectLight::hemisphere;
    double sum = 0.0, variance = 0.0;
    constexpr int kPictures = 6;
    for (std::uint32_t i = 0; i < kPictures; ++i) {
        settings.seed = 100 + i;
        const PictureMean mean = pictureMean(renderRounds(scene, settings, 64), 1);
        sum += mean.mean;
        variance += mean.standard_error * mean.standard_error;
    }
    const double standard_error = std::sqrt(variance) / kPictures;
    EXPECT_NEAR(sum / kPictures, known.mean, 4.5 * std::hypot(standard_error, known.standard_error));
    EXPECT_LT(standard_error, 0.02 * known.mean) << "too noisy to tell anything";
    RenderSettings plain = small(50);
    plain.bounces = 2;
    expectSamePicture(renderRounds(scene, plain, 256), reference, "adaptive");
}

// A wall that shines, free of noise, and in a corner of the picture a floor under a small lamp.
TEST(Adaptive, HasLessErrorWhereNoiseIsLocal) {
    Scene scene;
    scene.materials = {lambert(0.0F, 1.0F), lambert(0.8F), lambert(0.0F, 40.0F)};
    const auto square = [](std::uint32_t material, vec3 centre, float half, bool up) {
        const vec3 a = centre + vec3(-half, 0, half), b = centre + vec3(half, 0, half),
                   c = centre + vec3(half, 0, -half), d = centre + vec3(-half, 0, -half);
        return up ? quadMesh("square", material, a, b, c, d) : quadMesh("square", material, d, c, b, a);
    };
    place(scene, square(0, vec3(0, -4, 0), 4.0F, true));
    place(scene, square(1, vec3(-0.75F, 0, -0.75F), 0.25F, true));  // a sixteenth of the picture
    place(scene, square(2, vec3(-0.75F, 0.4F, -0.75F), 0.1F, false));
    scene.cameras = {downCamera(vec3(0.0F), 1.0F, 3.0F)};
    RenderSettings settings = small(6);
    settings.size = uvec2(64);
    settings.bounces = 1;
    settings.direct = DirectLight::hemisphere;
    RenderSettings sure = settings;
    sure.seed = 60;
    sure.direct = DirectLight::mis;
    const Image reference = colorOf(renderFilm(scene, scene.cameras[0], sure, 1024));
    const double uniform = relMse(colorOf(renderFilm(scene, scene.cameras[0], settings, 128)), reference);
    const Film rounds = renderRounds(scene, settings, 128);
    const double adaptive = relMse(colorOf(rounds), reference);
    // Rounds after the first give the noisy tiles nearly four times the average: 128 / (8 + 4 * 120) = 0.27
    // of the variance at best, and the rims of the floor's tiles keep some.
    EXPECT_LT(adaptive, 0.5 * uniform);
    EXPECT_GT(adaptive, 0.0);
    EXPECT_NEAR(relativeError(rounds) * relativeError(rounds) / adaptive, 1.0, 0.5)
        << "what it says of itself";
}

}  // namespace
}  // namespace licht
