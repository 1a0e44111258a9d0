// Thin films on the device: against the published closed form in double precision, and with themselves.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "bsdf_reference.h"
#include "kernel.h"
#include "licht/core/math.h"
#include "licht/measure/statistics.h"
#include "licht/spirv/iridescence_comp.h"

namespace licht {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kUnit = 0x1p-24;  // relative error of one fp32 rounding

struct Question {
    vec3 dielectric_f0{0.04F};
    float strength = 1.0F;
    vec3 metal_f0{0.5F, 0.7F, 0.9F};
    float ior = 1.3F;
    vec3 diffuse{0.0F};
    float thickness = 400.0F;
    float metallic = 0.0F;
    float alpha = 0.25F;
    float cosine = 0.8F;
    std::uint32_t seed = 1;
};
struct Answer {
    vec4 film;      // reflectance over the dielectric base; strength that is left
    vec4 specular;  // the specular layer's reflectance; what reaches the diffuse layer when wo and wi both
                    // have this cosine
    vec4 plain;     // the same without a film
    vec4 there;     // f, pdf
    vec4 back;
    vec4 weight;  // w: 1 when valid
};

std::vector<Answer> ask(const std::vector<Question>& questions, const gpu::SpecConstants& constants = {}) {
    test::Kernel kernel("iridescence", iridescence_comp, constants);
    struct {
        std::uint32_t count;
    } const push{static_cast<std::uint32_t>(questions.size())};
    return kernel.run<Answer>(push.count, push.count, push, questions);
}

double d(float x) {
    return static_cast<double>(x);
}

/// Belcour and Barla 2017 in the form of KHR_materials_iridescence, in metres and radians as it is published.
/// Without the clamp to [0,1].
std::array<double, 3> published(const Question& q) {
    const auto schlick = [](double f0, double cosine) {
        return f0 + (1.0 - f0) * std::pow(1.0 - cosine, 5.0);
    };
    const auto interface = [](double above, double below) {
        return std::pow((above - below) / (above + below), 2.0);
    };
    const double film = d(q.ior);
    const double cosine = d(q.cosine);
    const double cos_film = std::sqrt(1.0 - (1.0 - cosine * cosine) / (film * film));
    const double r12 = schlick(interface(1.0, film), cosine);
    const double t121 = 1.0 - r12;
    const double opd = 2.0 * film * d(q.thickness) * 1e-9 * cos_film;
    std::array<double, 3> base{};
    std::array<double, 3> within{};
    std::array<double, 3> r123{};
    std::array<double, 3> phi{};
    std::array<double, 3> result{};
    for (std::size_t c = 0; c < 3; ++c) {
        const double root = std::sqrt(std::min(d(q.dielectric_f0[static_cast<int>(c)]), 0.9999));
        base.at(c) = (1.0 + root) / (1.0 - root);
        const double r23 = schlick(interface(film, base.at(c)), cos_film);
        r123.at(c) = std::clamp(r12 * r23, 1e-5, 0.9999);
        within.at(c) = t121 * t121 * r23 / (1.0 - r123.at(c));
        phi.at(c) = kPi + (base.at(c) < film ? kPi : 0.0);
        result.at(c) = r12 + within.at(c);
    }
    for (int m = 1; m <= 2; ++m) {
        const double phase = 2.0 * kPi * m * opd;
        const auto gaussian = [&](double height, double position, double variance, double shift) {
            return height * std::sqrt(2.0 * kPi * variance) * std::cos(position * phase + m * shift) *
                   std::exp(-variance * phase * phase) / 1.0685e-7;
        };
        const double x = gaussian(5.4856e-13, 1.6810e6, 4.3278e9, phi[0]) +
                         gaussian(9.7470e-14, 2.2399e6, 4.5282e9, phi[0]);
        const double y = gaussian(4.4201e-13, 1.7953e6, 9.3046e9, phi[1]);
        const double z = gaussian(5.2481e-13, 2.2084e6, 6.6121e9, phi[2]);
        const std::array<double, 3> rgb{3.2404542 * x - 1.5371385 * y - 0.4985314 * z,
                                        -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
                                        0.0556434 * x - 0.2040259 * y + 1.0572252 * z};
        for (std::size_t c = 0; c < 3; ++c)
            result.at(c) += (within.at(c) - t121) * std::pow(std::sqrt(r123.at(c)), m) * 2.0 * rgb.at(c);
    }
    return result;
}

/// Films of every kind over bases of every kind, at many angles.
std::vector<Question> films() {
    std::vector<Question> questions;
    for (const float ior : {1.0F, 1.2F, 1.3F, 1.8F, 2.4F}) {
        for (const float thickness : {0.5F, 50.0F, 100.0F, 250.0F, 400.0F, 777.0F, 1200.0F, 5000.0F}) {
            for (const vec3& f0 :
                 {vec3(0.0F), vec3(0.04F), vec3(0.11F, 0.02F, 0.25F), vec3(0.95F, 0.6F, 0.3F), vec3(1.0F)}) {
                for (int i = 1; i <= 20; ++i) {
                    Question q;
                    q.ior = ior;
                    q.thickness = thickness;
                    q.dielectric_f0 = f0;
                    q.cosine = static_cast<float>(i) / 20.0F;
                    questions.push_back(q);
                }
            }
        }
    }
    return questions;
}

TEST(ThinFilm, followsThePublishedForm) {
    // A Gaussian's cosine rounds by 2 pi 3 u of its turns, and turns times decay are at most 2.3 (near 1700
    // nm): 43 u; its own polynomial, the decay and the products round below 20 u. The second order's cosine
    // is 2 c^2 - 1, four times as wrong, while its turns double and its decay halves their reach: no more
    // than the first order's. The matrix' rows sum to at most 5.3, both orders' amplitudes, doubled, to at
    // most 4: 1340 u. The rational terms round twelve times, and 1 - r123 >= 1 - r12 >= 0.22 (from cosine
    // 0.05 on) divides them: 60 u, four times over in the amplitudes.
    constexpr double kTolerance = (1340.0 + 5.0 * 60.0) * kUnit;
    const std::vector<Question> questions = films();
    const std::vector<Answer> answers = ask(questions);
    double worst = 0.0;
    double most = 0.0;
    for (std::size_t i = 0; i < questions.size(); ++i) {
        const Question& q = questions[i];
        const std::array<double, 3> expected = published(q);
        for (int c = 0; c < 3; ++c) {
            const double value = std::clamp(expected.at(static_cast<std::size_t>(c)), 0.0, 1.0);
            ASSERT_NEAR(d(answers[i].film[c]), value, kTolerance)
                << "ior " << q.ior << " thickness " << q.thickness << " f0 " << q.dielectric_f0[c] << " cos "
                << q.cosine;
            worst = std::max(worst, std::abs(d(answers[i].film[c]) - value));
            most = std::max(most, std::abs(value - d(answers[i].plain[c])));
        }
        EXPECT_EQ(answers[i].film.w, 1.0F);
    }
    RecordProperty("worst error in units", std::to_string(worst / kUnit));
    EXPECT_GT(most, 0.3) << "a film must show";
}

TEST(ThinFilm, reflectsBetweenNothingAndAll) {
    for (const Answer& a : ask(films(), test::asInTheTextbook())) {
        for (int c = 0; c < 3; ++c) {
            EXPECT_GE(a.film[c], 0.0F);
            EXPECT_LE(a.film[c], 1.0F);
        }
        // As glTF has it, the diffuse layer receives what the strongest channel leaves.
        EXPECT_EQ(a.specular.w, 1.0F - std::max({a.film.x, a.film.y, a.film.z}));
        EXPECT_EQ(vec3(a.specular), vec3(a.film));
    }
}

TEST(ThinFilm, withoutStrengthOrThicknessIsPlain) {
    std::vector<Question> questions = films();
    for (std::size_t i = 0; i < questions.size(); ++i) {
        questions[i].diffuse = vec3(0.8F);
        (i % 2 == 0 ? questions[i].strength : questions[i].thickness) = 0.0F;
    }
    std::vector<Question> bare = questions;
    for (Question& q : bare) q.strength = q.thickness = 0.0F;
    const std::vector<Answer> answers = ask(questions);
    const std::vector<Answer> plain = ask(bare);
    for (std::size_t i = 0; i < answers.size(); ++i) {
        EXPECT_EQ(answers[i].film.w, 0.0F);
        EXPECT_EQ(answers[i].specular, answers[i].plain);
        EXPECT_EQ(answers[i].there, plain[i].there);
        EXPECT_EQ(answers[i].weight, plain[i].weight);
    }
}

TEST(ThinFilm, mixesByStrengthAndMetal) {
    Question half;
    half.strength = 0.5F;
    half.metallic = 0.25F;
    Question dielectric;
    Question metal;
    metal.dielectric_f0 = metal.metal_f0;
    const std::vector<Answer> a = ask({half, dielectric, metal}, test::asInTheTextbook());
    for (int c = 0; c < 3; ++c) {
        const double film = 0.75 * d(a[1].film[c]) + 0.25 * d(a[2].film[c]);
        EXPECT_NEAR(d(a[0].specular[c]), 0.5 * d(a[0].plain[c]) + 0.5 * film, 8.0 * kUnit);
    }
    // Only what the dielectric share reflects is kept from the diffuse layer; without a film, as under any
    // specular layer.
    const double passed = 1.0 - d(std::max({a[1].film.x, a[1].film.y, a[1].film.z}));
    const double cosine = d(half.cosine);
    const double plain =
        test::reference::passed(test::plastic(vec3(0.0F), half.alpha, half.dielectric_f0.x, 1.0F), cosine);
    EXPECT_NEAR(d(a[0].plain.w), plain, 6.0 * kUnit);  // what 1 - F rounds by
    EXPECT_NEAR(d(a[0].specular.w), 0.5 * d(a[0].plain.w) + 0.5 * passed, 4.0 * kUnit);
}

TEST(ThinFilm, isReciprocal) {
    std::vector<Question> questions = films();
    for (Question& q : questions) q.diffuse = vec3(0.8F);
    for (const Answer& a : ask(questions)) {
        for (int c = 0; c < 3; ++c) {
            // dot(wo, h) and dot(wi, h) differ by roundings alone: 12 u of the angle, whose share of the
            // phase (at 5000 nm and ior 2.4: 53 turns, damped to nothing) is held by the tolerance of the
            // closed form.
            const double tolerance = 1640.0 * kUnit * std::max(1.0, d(a.there[c]));
            EXPECT_NEAR(d(a.there[c]), d(a.back[c]), tolerance);
        }
    }
}

/// Of what samples of one question carry.
std::array<RunningStatistics, 3> weights(const Question& question, std::size_t count,
                                         const gpu::SpecConstants& constants = {}) {
    std::array<RunningStatistics, 3> statistics;
    for (const Answer& a : ask(std::vector<Question>(count, question), constants)) {
        for (int c = 0; c < 3; ++c) {
            const double weight = a.weight.w > 0.0F ? d(a.weight[c]) : 0.0;
            EXPECT_TRUE(std::isfinite(weight) && weight >= 0.0);
            statistics.at(static_cast<std::size_t>(c)).add(weight);
        }
    }
    return statistics;
}

double noise(const RunningStatistics& statistics) {
    return 4.5 * std::sqrt(statistics.varianceOfMean()) + 64.0 * kUnit;
}

TEST(ThinFilm, samplesCarryNoMoreThanArrives) {
    for (const float cosine : {1.0F, 0.7F, 0.3F, 0.05F}) {
        for (const float thickness : {100.0F, 250.0F, 400.0F}) {
            for (const float f0 : {0.04F, 1.0F}) {
                for (const float alpha : {1e-3F, 0.25F, 1.0F}) {
                    Question q;
                    q.dielectric_f0 = vec3(f0);
                    q.ior = 1.8F;
                    q.thickness = thickness;
                    q.alpha = alpha;
                    q.cosine = cosine;
                    for (const RunningStatistics& w : weights(q, std::size_t{1} << 14U)) {
                        EXPECT_LE(w.mean(), 1.0 + noise(w)) << "cos " << cosine << " thickness " << thickness
                                                            << " f0 " << f0 << " alpha " << alpha;
                        EXPECT_GT(w.mean(), 0.0);
                    }
                }
            }
        }
    }
}

std::array<double, 3> reflectance(Question q, double cosine) {
    q.cosine = static_cast<float>(std::min(cosine, 1.0));
    std::array<double, 3> result = published(q);
    for (double& r : result) r = std::clamp(r, 0.0, 1.0);
    return result;
}

/// Albedo of the specular layer alone, by the midpoint rule over the half vectors.
std::array<double, 3> specularAlbedo(const Question& q, int steps) {
    const test::Material mirror = test::mirror(q.alpha);
    const test::dvec3 wo(test::outgoing(d(q.cosine)));
    std::array<double, 3> sum{};
    for (int y = 0; y < steps; ++y) {
        for (int x = 0; x < steps; ++x) {
            const test::NormalCell cell =
                test::normalAt(d(q.alpha), (y + 0.5) * 0.5 * kPi / steps, (x + 0.5) * 2.0 * kPi / steps);
            const double cos_h = glm::dot(wo, cell.h);
            const test::dvec3 wi = 2.0 * cos_h * cell.h - wo;
            if (cos_h <= 0.0 || wi.z <= 0.0) continue;
            const double share = test::reference::f(mirror, 0, wo, wi) * wi.z * 4.0 * cos_h *
                                 cell.solid_angle * kPi * kPi / (steps * static_cast<double>(steps));
            const std::array<double, 3> r = reflectance(q, cos_h);
            for (std::size_t c = 0; c < 3; ++c) sum.at(c) += share * r.at(c);
        }
    }
    return sum;
}

const gpu::SpecConstants kReflectedOnce{{kConstantEnergy, kEnergySingle}};

/// A white diffuse layer's share of what the question's angle shows. The layers pass l(o) l(i), of which the
/// device tells l^2 for equal angles; the mean of l by cosine is the midpoint rule's over squared cosines.
double shownBelow(const Question& question, std::size_t steps) {
    std::vector<Question> questions(steps, question);
    for (std::size_t i = 0; i < steps; ++i)
        questions[i].cosine =
            static_cast<float>(std::sqrt((static_cast<double>(i) + 0.5) / static_cast<double>(steps)));
    questions.push_back(question);
    std::vector<double> left;
    for (const Answer& a : ask(questions, kReflectedOnce)) left.push_back(std::sqrt(d(a.specular.w)));
    const double towards_o = left.back();
    left.pop_back();
    return towards_o * std::accumulate(left.begin(), left.end(), 0.0) / static_cast<double>(steps);
}

struct Film {
    float ior;
    float thickness;
    float f0;
};

Question overWhite(const Film& film, float alpha, float cosine) {
    Question q;
    q.dielectric_f0 = vec3(film.f0);
    q.ior = film.ior;
    q.diffuse = vec3(1.0F);
    q.thickness = film.thickness;
    q.alpha = alpha;
    q.cosine = cosine;
    return q;
}

std::string nameOf(const Question& q) {
    return fmt::format("ior {}, thickness {}, f0 {}, alpha {}, cosine {}", q.ior, q.thickness,
                       q.dielectric_f0.x, q.alpha, q.cosine);
}

// What a film leaves to a layer below has no colour, and both layers show what they give.
TEST(ThinFilm, overAWhiteDiffuseLayerShowsWhatBothGive) {
    for (const Film& film : {Film{1.8F, 300.0F, 0.0F}, Film{1.3F, 400.0F, 0.25F}})
        for (const float alpha : {1e-3F, 0.3F}) {
            const Question q = overWhite(film, alpha, 0.3F);
            const std::array<double, 3> specular = specularAlbedo(q, 256);
            const std::array<double, 3> coarse = specularAlbedo(q, 128);
            const double below = shownBelow(q, 1024);
            const double below_error = std::abs(below - shownBelow(q, 512));
            const std::array<RunningStatistics, 3> carried =
                weights(q, std::size_t{1} << 16U, kReflectedOnce);
            for (std::size_t c = 0; c < 3; ++c) {
                // The midpoint rules are off by no more than what halving their steps changes.
                const double tolerance =
                    noise(carried.at(c)) + std::abs(specular.at(c) - coarse.at(c)) + below_error;
                EXPECT_NEAR(carried.at(c).mean(), specular.at(c) + below, tolerance) << nameOf(q);
            }
        }
}

// The strongest channel shows one, to what the quadrature of the film's mean is off by and the fits of
// what its microfacets reflect, see energy_test.cpp.
TEST(ThinFilm, overAWhiteDiffuseLayerShowsOneInItsStrongestChannel) {
    for (const Film& film : {Film{1.8F, 300.0F, 0.0F}, Film{2.4F, 100.0F, 0.0F}, Film{1.3F, 400.0F, 0.25F},
                             Film{1.3F, 400.0F, 0.04F}, Film{1.8F, 800.0F, 0.04F}})
        for (const float alpha : {1e-3F, 0.1F, 0.3F, 1.0F})
            for (const float cosine : {1.0F, 0.7F, 0.3F, 0.05F}) {
                const Question q = overWhite(film, alpha, cosine);
                double strongest = 0.0;
                double error = 0.0;
                for (const RunningStatistics& w :
                     weights(q, std::size_t{1} << 15U, {{kConstantLayering, kLayeringView}}))
                    if (w.mean() > strongest) {
                        strongest = w.mean();
                        error = noise(w);
                    }
                EXPECT_NEAR(strongest, 1.0, 0.01 + error) << nameOf(q);
            }
}

}  // namespace
}  // namespace licht
