// The scattering function on the device: as glTF has it against the textbook in double precision and against
// closed forms, and with itself also where it gives what it gets (energy_test.cpp says how much that is).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "bsdf_reference.h"
#include "kernel.h"
#include "licht/film/error_estimate.h"
#include "licht/measure/statistics.h"
#include "licht/spirv/bsdf_comp.h"
#include "licht/spirv/bsdf_sampling_comp.h"

namespace licht {
namespace {

using test::dvec3;
using test::Material;
using test::materials;
using test::mirror;
using test::NamedMaterial;
using test::outgoing;
using test::plastic;

constexpr double kPi = std::numbers::pi;
constexpr double kUnit = 0x1p-24;  // relative error of one fp32 rounding
constexpr double kSigmas = 4.5;    // 7e-6 of all samples of a normal lie beyond, on both sides together
constexpr std::uint32_t kSamples = 1U << 18U;

double d(float x) {
    return static_cast<double>(x);
}

struct Sample {
    vec4 wi_pdf;  // w: pdf, -1 when absorbed
    vec4 weight;
    vec4 normal;

    [[nodiscard]] bool valid() const { return wi_pdf.w >= 0.0F; }
};

class AnyBsdf : public testing::Test {
protected:
    explicit AnyBsdf(const gpu::SpecConstants& constants)
        : evaluate_("bsdf", bsdf_comp, constants), sample_("bsdf samples", bsdf_sampling_comp, constants) {}

    /// Pairs of directions wo, wi. Answer 2 i: f and pdf; answer 2 i + 1: Fresnel factor for wo.z, D of wo as
    /// a normal.
    std::vector<vec4> evaluate(const Material& material, const std::vector<vec4>& pairs) {
        struct {
            Material material;
            std::uint32_t count;
        } push{material, static_cast<std::uint32_t>(pairs.size() / 2)};
        return evaluate_.run<vec4>(push.count, pairs.size(), push, pairs);
    }

    std::vector<Sample> sample(const Material& material, vec3 wo, std::uint32_t count = kSamples) {
        struct {
            Material material;
            std::uint32_t count;
            std::uint32_t seed;
            std::uint32_t pad[2];
            vec4 wo;
        } push{material, count, 1, {0, 0}, vec4(wo, 0.0F)};
        return sample_.run<Sample>(count, count, push, std::vector<std::uint32_t>{0});
    }

    void expectReciprocal();
    void expectWeightsFollowValues();
    void expectSoundSamples(const std::vector<NamedMaterial>& materials, bool scattered_once);

private:
    test::Kernel evaluate_;
    test::Kernel sample_;
};

class Bsdf : public AnyBsdf {
protected:
    Bsdf() : AnyBsdf(test::asInTheTextbook()) {}
};

/// As it is unless it is asked for otherwise.
class BalancedBsdf : public AnyBsdf {
protected:
    BalancedBsdf() : AnyBsdf({}) {}
};

std::vector<vec4> randomPairs(int count) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> cosine(0.001F, 1.0F);
    std::uniform_real_distribution<float> angle(0.0F, 6.28F);
    std::vector<vec4> directions;
    for (int i = 0; i < 2 * count; ++i) {
        const float z = cosine(random);
        const float phi = angle(random);
        const float r = std::sqrt(1.0F - z * z);
        directions.emplace_back(r * std::cos(phi), r * std::sin(phi), z, 0.0F);
    }
    return directions;
}

/// What rounding may do to dot(wo, h) of the normal half-way: directions are unit to 2 u, which the length of
/// wo + wi divides, and sums and products round a few times.
double halfCosineError(const dvec3& wo, const dvec3& wi) {
    return 6.0 * kUnit * (1.0 + 1.0 / glm::length(wo + wi));
}

/// The Fresnel factor f0 + (1 - f0) m^5 changes by 5 m^4 of its argument; at most 8 times relative to itself,
/// for every f0 from 0.02 up (the maximum over m is at m^5 = 4 f0). Everything else rounds below 24 times.
double relativeError(const dvec3& wo, const dvec3& wi) {
    return 24.0 * kUnit + 8.0 * halfCosineError(wo, wi);
}

/// Relative, of what the specular layer passes: near grazing 1 - F cancels. F is below one, where a rounding
/// is at most u / 2; it changes by at most five times its cosine, and its three products, the difference to
/// f90, scaling, adding and 1 - F follow: 6 u.
double passedError(const Material& m, const dvec3& wo, const dvec3& wi) {
    const double cos_h = glm::dot(wo, glm::normalize(wo + wi));
    return (6.0 * kUnit + 5.0 * halfCosineError(wo, wi)) / test::reference::passed(m, cos_h);
}

void AnyBsdf::expectReciprocal() {
    const std::vector<vec4> pairs = randomPairs(10'000);
    std::vector<vec4> swapped = pairs;
    for (std::size_t i = 0; i < swapped.size(); i += 2) std::swap(swapped[i], swapped[i + 1]);
    for (const NamedMaterial& m : materials()) {
        const std::vector<vec4> there = evaluate(m.material, pairs);
        const std::vector<vec4> back = evaluate(m.material, swapped);
        double worst = 0.0;
        for (std::size_t i = 0; i < pairs.size(); i += 2) {
            for (int c = 0; c < 3; ++c) {
                const double a = d(there[i][c]);
                const double b = d(back[i][c]);
                // A smooth lobe amplifies nothing: the half vector has the same bits either way.
                ASSERT_NEAR(a, b, relativeError(dvec3(pairs[i]), dvec3(pairs[i + 1])) * a)
                    << m.name << " " << i / 2;
                worst = std::max(worst, std::abs(a - b) / std::max(a, 1e-30));
            }
        }
        EXPECT_LT(worst, 1e-5) << m.name;
        RecordProperty("worst " + m.name, std::to_string(worst * 1e6));
    }
}

TEST_F(Bsdf, isReciprocal) {
    expectReciprocal();
}

TEST_F(BalancedBsdf, isReciprocal) {
    expectReciprocal();
}

TEST_F(Bsdf, followsTheTextbook) {
    const std::vector<vec4> pairs = randomPairs(10'000);
    for (const NamedMaterial& m : materials()) {
        const std::vector<vec4> answers = evaluate(m.material, pairs);
        for (std::size_t i = 0; i < pairs.size(); i += 2) {
            const dvec3 wo(pairs[i]);
            const dvec3 wi(pairs[i + 1]);
            const dvec3 h = glm::normalize(wo + wi);
            const auto alpha = d(m.material.alpha);
            // The half vector rounds like its cosine, and D = alpha^2 / (pi (alpha^2 z^2 + x^2 + y^2)^2)
            // changes by at most 4 times its tangential error over the length of (alpha z, x, y).
            const double lobe = 4.0 * halfCosineError(wo, wi) / std::hypot(alpha * h.z, std::hypot(h.x, h.y));
            const double tolerance = relativeError(wo, wi) + lobe;
            for (int c = 0; c < 3; ++c) {
                const double f = test::reference::f(m.material, c, wo, wi);
                const double below =
                    d(m.material.diffuse[c]) * test::reference::passed(m.material, glm::dot(wo, h)) / kPi;
                const double cancelled = below > 0.0 ? passedError(m.material, wo, wi) * below : 0.0;
                ASSERT_NEAR(d(answers[i][c]), f, tolerance * f + cancelled) << m.name << " " << i / 2;
            }
            const double pdf = test::reference::pdf(m.material, wo, wi);
            ASSERT_NEAR(d(answers[i].w), pdf, tolerance * pdf) << m.name << " " << i / 2;
        }
    }
}

TEST_F(Bsdf, fresnelGoesFromF0ToF90) {
    const Material m{vec3(0.0F), 0.5F, vec3(0.04F, 0.3F, 0.9F), 0.75F, vec3(0.0F), 0.0F};
    const std::vector<vec4> answers =
        evaluate(m, {vec4(0, 0, 1, 0), vec4(0, 0, 1, 0), vec4(1, 0, 0, 0), vec4(0, 0, 1, 0)});
    EXPECT_EQ(vec3(answers[1]), m.dielectric_f0);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(d(answers[3][c]), 0.75, 2.0 * kUnit);  // f0 + (f90 - f0)
}

TEST_F(Bsdf, normalsCoverTheirProjectedArea) {
    // The integral of D cos over the hemisphere is one; along psi the integrand is sin(2 psi), and the
    // midpoint rule over n steps is off by pi^2 / (24 n^2) of it.
    constexpr int kSteps = 4096;
    for (const float alpha : {1e-3F, 0.05F, 0.25F, 1.0F}) {
        std::vector<vec4> pairs;
        for (int i = 0; i < kSteps; ++i) {
            const double psi = (i + 0.5) * 0.5 * kPi / kSteps;
            pairs.emplace_back(test::normalAt(d(alpha), psi, 0.7).h, 0.0);
            pairs.emplace_back(0.0F, 0.0F, 1.0F, 0.0F);
        }
        const std::vector<vec4> answers = evaluate(mirror(alpha), pairs);
        double sum = 0.0;
        for (int i = 0; i < kSteps; ++i) {
            const double psi = (i + 0.5) * 0.5 * kPi / kSteps;
            const test::NormalCell cell = test::normalAt(d(alpha), psi, 0.7);
            sum += d(answers[static_cast<std::size_t>(2 * i + 1)].w) * cell.h.z * cell.solid_angle * 0.5 *
                   kPi / kSteps;
        }
        // D rounds eight times and its input four times twice over.
        EXPECT_NEAR(2.0 * kPi * sum, 1.0, 16.0 * kUnit + kPi * kPi / (24.0 * kSteps * kSteps)) << alpha;
    }
}

TEST_F(Bsdf, densityIntegratesToWhatIsNotAbsorbed) {
    for (const NamedMaterial& m : materials()) {
        for (const double cosine : {1.0, 0.5, 0.1}) {
            const vec3 wo = outgoing(cosine);
            // The diffuse layer is integrated over wi and the specular layer over h, each with its own share
            // of the density, so that both integrands are smooth; the specular layer's grid is halved to see
            // how right it is.
            const auto integral = [&](int steps) {
                std::vector<vec4> pairs;
                std::vector<double> areas;
                const double share = test::reference::specularShare(m.material, dvec3(wo));
                for (int y = 0; y < steps; ++y) {
                    for (int x = 0; x < steps; ++x) {
                        const double psi = (y + 0.5) * 0.5 * kPi / steps;
                        const double phi = (x + 0.5) * 2.0 * kPi / steps;
                        const test::NormalCell cell = test::normalAt(d(m.material.alpha), psi, phi);
                        const double cos_h = glm::dot(dvec3(wo), cell.h);
                        const dvec3 wi = 2.0 * cos_h * cell.h - dvec3(wo);
                        if (cos_h <= 0.0 || wi.z <= 0.0) continue;
                        pairs.emplace_back(wo, 0.0F);
                        pairs.emplace_back(wi, 0.0);
                        areas.push_back(4.0 * cos_h * cell.solid_angle * kPi * kPi /
                                        (steps * static_cast<double>(steps)));
                    }
                }
                const std::vector<vec4> answers = evaluate(m.material, pairs);
                double sum = 1.0 - share;
                for (std::size_t i = 0; i < areas.size(); ++i)
                    sum += (d(answers[2 * i].w) - (1.0 - share) * d(pairs[2 * i + 1].z) / kPi) * areas[i];
                return sum;
            };
            const double fine = integral(512);
            const double quadrature_error = std::abs(fine - integral(256));
            double absorbed = 0.0;
            for (const Sample& s : sample(m.material, wo)) absorbed += s.valid() ? 0.0 : 1.0;
            const double share = absorbed / kSamples;
            // Without any absorbed sample the share is below 12 / n, with 6e-6 left for chance.
            const double noise = kSigmas * std::sqrt(share * (1.0 - share) / kSamples) + 12.0 / kSamples;
            EXPECT_NEAR(fine, 1.0 - share, noise + quadrature_error + 64.0 * kUnit)
                << m.name << " " << cosine;
            EXPECT_LT(quadrature_error, 2e-3) << m.name << " " << cosine;
        }
    }
}

RunningStatistics weights(const std::vector<Sample>& samples, int channel) {
    RunningStatistics statistics;
    for (const Sample& s : samples) statistics.add(s.valid() ? d(s.weight[channel]) : 0.0);
    return statistics;
}

/// Directional albedo by the midpoint rule from the reference.
double albedo(const Material& m, int channel, const dvec3& wo) {
    constexpr int kSteps = 512;
    Material specular = m;
    specular.diffuse = vec3(0.0F);
    double sum = 0.0;
    for (int y = 0; y < kSteps; ++y) {
        for (int x = 0; x < kSteps; ++x) {
            const double phi = (x + 0.5) * 2.0 * kPi / kSteps;
            const double c =
                std::sqrt((y + 0.5) / kSteps);  // equal steps of cos^2: the cosine's density is uniform
            const double s = std::sqrt(1.0 - c * c);
            const dvec3 down(s * std::cos(phi), s * std::sin(phi), c);
            sum +=
                d(m.diffuse[channel]) * test::reference::passed(m, glm::dot(wo, glm::normalize(wo + down)));
            const test::NormalCell cell = test::normalAt(d(m.alpha), (y + 0.5) * 0.5 * kPi / kSteps, phi);
            const double cos_h = glm::dot(wo, cell.h);
            const dvec3 wi = 2.0 * cos_h * cell.h - wo;
            if (cos_h > 0.0 && wi.z > 0.0)
                sum += test::reference::f(specular, channel, wo, wi) * wi.z * 4.0 * cos_h * cell.solid_angle *
                       kPi * kPi;
        }
    }
    return sum / (static_cast<double>(kSteps) * kSteps);
}

TEST_F(Bsdf, albedoIsRight) {
    for (const NamedMaterial& m : materials()) {
        for (const double cosine : {1.0, 0.7, 0.3, 0.05}) {
            const vec3 wo = outgoing(cosine);
            const std::vector<Sample> samples = sample(m.material, wo);
            for (int c = 0; c < 3; ++c) {
                const RunningStatistics w = weights(samples, c);
                const double noise = kSigmas * std::sqrt(w.varianceOfMean());
                // The midpoint rule cuts the horizon off by less than a cell in 512, along which f cos is
                // small: a thousandth of the largest albedo.
                EXPECT_NEAR(w.mean(), albedo(m.material, c, dvec3(wo)), noise + 1e-3)
                    << m.name << " " << cosine;
            }
        }
    }
}

TEST_F(Bsdf, singleScatteringOfAWhiteSpecularLayer) {
    struct {
        float alpha;
        double cosine;
        double expected;
    } const known[] = {
        {1.0F, 1.0, 1.0 - std::numbers::ln2},  // closed form
        {1.0F, 0.5, 0.4507},
        {0.5F, 1.0, 0.6879},
        {0.5F, 0.5, 0.6982},
        {0.25F, 1.0, 0.9157},
        {0.25F, 0.5, 0.8572},
    };
    for (const auto& [alpha, cosine, expected] : known) {
        const RunningStatistics w = weights(sample(mirror(alpha), outgoing(cosine)), 0);
        // 5e-4: how precisely the values are stated.
        EXPECT_NEAR(w.mean(), expected, 5e-4 + kSigmas * std::sqrt(w.varianceOfMean()))
            << alpha << " " << cosine;
    }
}

void AnyBsdf::expectWeightsFollowValues() {
    for (const NamedMaterial& m : materials()) {
        for (const double cosine : {1.0, 0.5, 0.05, 1e-3}) {
            const vec3 wo = outgoing(cosine);
            const std::vector<Sample> samples = sample(m.material, wo, 1U << 14U);
            std::vector<vec4> pairs;
            for (const Sample& s : samples) {
                pairs.emplace_back(wo, 0.0F);
                pairs.emplace_back(vec3(s.wi_pdf), 0.0F);
            }
            const std::vector<vec4> answers = evaluate(m.material, pairs);
            std::size_t valid = 0;
            for (std::size_t i = 0; i < samples.size(); ++i) {
                if (!samples[i].valid()) continue;
                ++valid;
                const double pdf = d(answers[2 * i].w);
                ASSERT_NEAR(d(samples[i].wi_pdf.w), pdf, 1e-4 * pdf) << m.name << " " << cosine;
                for (int c = 0; c < 3; ++c) {
                    const double weight = d(answers[2 * i][c]) * d(samples[i].wi_pdf.z) / pdf;
                    ASSERT_NEAR(d(samples[i].weight[c]), weight, 1e-4 * weight) << m.name << " " << cosine;
                }
            }
            EXPECT_GT(valid, samples.size() / 4) << m.name << " " << cosine;
        }
    }
}

TEST_F(Bsdf, weightIsValueTimesCosineOverDensity) {
    expectWeightsFollowValues();
}

TEST_F(BalancedBsdf, weightIsValueTimesCosineOverDensity) {
    expectWeightsFollowValues();
}

std::vector<NamedMaterial> withMirrors() {
    std::vector<NamedMaterial> all = materials();
    for (const float alpha : {1e-3F, 0.02F, 0.1F}) all.push_back({"mirror", mirror(alpha)});
    return all;
}

void AnyBsdf::expectSoundSamples(const std::vector<NamedMaterial>& all, bool scattered_once) {
    for (const NamedMaterial& m : all) {
        const bool specular_alone =
            scattered_once && m.material.f0() == dvec3(1.0) && m.material.diffuse == vec3(0.0F);
        for (const double cosine : {1.0, 0.1, 1e-3, 1e-6, 0.0}) {
            std::size_t valid = 0;
            for (const Sample& s : sample(m.material, outgoing(cosine), 1U << 16U)) {
                ASSERT_NEAR(glm::length(dvec3(s.normal)), 1.0, 1e-6) << m.name << " " << cosine;
                if (!s.valid()) continue;
                ++valid;
                ASSERT_NEAR(glm::length(dvec3(s.wi_pdf)), 1.0, 1e-6) << m.name << " " << cosine;
                ASSERT_GT(s.wi_pdf.z, 0.0F);
                ASSERT_TRUE(std::isfinite(s.wi_pdf.w) && s.wi_pdf.w > 0.0F) << m.name << " " << cosine;
                for (int c = 0; c < 3; ++c) {
                    ASSERT_TRUE(std::isfinite(s.weight[c]) && s.weight[c] >= 0.0F) << m.name << " " << cosine;
                    // G2 / G1, of which D cancels: at most one but for some ten roundings.
                    if (specular_alone) {
                        ASSERT_LE(d(s.weight[c]), 1.0 + 16.0 * kUnit) << m.name << " " << cosine;
                    }
                }
            }
            EXPECT_EQ(valid > 0, cosine > 0.0) << m.name << " " << cosine;
        }
    }
}

TEST_F(Bsdf, samplesAreSoundAtEveryAngle) {
    expectSoundSamples(withMirrors(), true);
}

TEST_F(BalancedBsdf, samplesAreSoundAtEveryAngle) {
    expectSoundSamples(withMirrors(), false);
}

}  // namespace
}  // namespace licht
