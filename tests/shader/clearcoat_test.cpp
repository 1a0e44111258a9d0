// The clearcoat over every kind of layer, on the device.
#include <gtest/gtest.h>

#include <cstdint>

#include "bsdf_reference.h"
#include "licht/shared/effects.h"
#include "licht/spirv/clearcoat_comp.h"
#include "lobe_test.h"

namespace licht {
namespace {

using test::dvec3;

struct Parameters {
    vec3 diffuse{0.0F};
    float alpha = 0.3F;
    vec3 f0{0.0F};
    float f90 = 0.0F;
    float factor = 1.0F;
    float coat_alpha = 0.3F;
    float tilt = 0.0F;
    float metallic = 0.0F;
};
using Lobe = test::Lobe<Parameters>;

double d(float x) {
    return static_cast<double>(x);
}

constexpr float kTilt = 0.3F;
const std::pair<const char*, Parameters> kMaterials[]{
    {"over black", {}},
    {"over white", {.diffuse = vec3(1.0F)}},
    {"over plastic", {.diffuse = vec3(1.0F), .f0 = vec3(0.04F), .f90 = 1.0F}},
    {"over a mirror", {.alpha = 0.25F, .f0 = vec3(1.0F), .f90 = 1.0F, .coat_alpha = 0.25F}},
    {"half of it", {.diffuse = vec3(0.9F, 0.5F, 0.1F), .factor = 0.5F, .coat_alpha = 1.0F}},
    {"tilted over white", {.diffuse = vec3(1.0F), .tilt = kTilt}},
    {"tilted over a mirror", {.f0 = vec3(1.0F), .f90 = 1.0F, .tilt = kTilt}},
};

TEST(Clearcoat, IsSampledByItsDensityAndGainsNothing) {
    test::Kernel kernel("clearcoat", clearcoat_comp);
    for (const auto& [name, parameters] : kMaterials) {
        const Lobe lobe(kernel, name, parameters);
        if (parameters.tilt == 0.0F) lobe.expectReciprocal();
        for (const double cosine : {1.0, 0.5, 0.2}) {
            // The coat's normal is never turned away from wo, see shadingNormal().
            const vec3 wo = test::towards(cosine, parameters.tilt == 0.0F ? 0.7 : 0.2);
            lobe.expectSamplesFollowDensity(wo, static_cast<int>(std::size(kMaterials) * 3));
            // The fits add at most that to each of both layers, see energy_test.cpp.
            lobe.expectNoGain(wo, 2.0 * 0.001);
        }
    }
}

// By the view alone nothing is lost but by the fits of both layers, a hundredth each, see energy_test.cpp. By
// both directions another hundredth: the specular layer below counts as a mirror, and what it sends to where
// the coat passes less is lost.
TEST(Clearcoat, OverWhiteShowsOne) {
    test::Kernel by_view("clearcoat", clearcoat_comp, {{kConstantLayering, kLayeringView}});
    test::Kernel by_both("clearcoat", clearcoat_comp, {{kConstantLayering, kLayeringAlbedo}});
    for (const float alpha : {0.01F, 0.09F, 0.3F, 1.0F})
        for (const float coat_alpha : {0.01F, 0.09F, 0.3F, 1.0F})
            for (const double cosine : {1.0, 0.7, 0.25, 0.1}) {
                const Parameters plastic{.diffuse = vec3(1.0F),
                                         .alpha = alpha,
                                         .f0 = vec3(0.04F),
                                         .f90 = 1.0F,
                                         .coat_alpha = coat_alpha};
                const std::string name = std::to_string(alpha) + " under " + std::to_string(coat_alpha);
                const vec3 wo = test::towards(cosine);
                Lobe(by_view, name, plastic).expectLittleLoss(wo, 2.0 * 0.01);
                Lobe(by_view, name, plastic).expectNoGain(wo, 2.0 * 0.001);
                Lobe(by_both, name, plastic).expectLittleLoss(wo, 3.0 * 0.01);
                Lobe(by_both, name, plastic).expectNoGain(wo, 2.0 * 0.001);
            }
}

/// Pairs of directions, all above the surface.
std::vector<vec4> pairs() {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(0.01, 1.0);
    std::vector<vec4> result;
    for (int i = 0; i < 4096; ++i)
        result.emplace_back(test::towards(unit(random), 6.28 * unit(random)), 0.0F);
    return result;
}

double fresnel(double cosine) {
    return test::reference::fresnel(d(0.04F), 1.0, cosine);
}

TEST(Clearcoat, FollowsTheTextbook) {
    test::Kernel kernel("clearcoat", clearcoat_comp, test::asInTheTextbook());
    const Parameters parameters{.diffuse = vec3(0.8F), .factor = 0.7F};
    const test::Material coat = test::plastic(vec3(0.0F), parameters.coat_alpha, 0.04F, 1.0F);
    const std::vector<vec4> asked = pairs();
    const auto answers = Lobe(kernel, "", parameters).ask(asked);
    for (std::size_t i = 0; i < answers.size(); ++i) {
        const dvec3 wo(asked[2 * i]);
        const dvec3 wi(asked[2 * i + 1]);
        const double passed = 1.0 - d(0.7F) * std::max(fresnel(wo.z), fresnel(wi.z));
        const double f = d(0.7F) * test::reference::f(coat, 0, wo, wi) + d(0.8F) / std::numbers::pi * passed;
        // As in bsdf_test.cpp: the Fresnel factor, and the slope of D over the half vector's rounding.
        const double rounding = 6.0 * 0x1p-24 * (1.0 + 1.0 / glm::length(wo + wi));
        const dvec3 h = glm::normalize(wo + wi);
        const double lobe = 4.0 / std::hypot(d(parameters.coat_alpha) * h.z, std::hypot(h.x, h.y));
        ASSERT_NEAR(d(answers[i].value.x), f, (24.0 * 0x1p-24 + (8.0 + lobe) * rounding) * f + 0x1p-22) << i;
    }
}

TEST(Clearcoat, WithoutAShareIsNotThere) {
    test::Kernel with("clearcoat", clearcoat_comp);
    test::Kernel without("no clearcoat", clearcoat_comp, {{kEffectClearcoat, 0U}});
    Parameters parameters{
        .diffuse = vec3(0.8F), .f0 = vec3(0.04F), .f90 = 1.0F, .factor = 0.0F, .tilt = kTilt};
    const auto a = Lobe(with, "", parameters).ask(pairs());
    parameters.factor = 1.0F;
    const auto b = Lobe(without, "", parameters).ask(pairs());
    // The same products, which two programs may group in two ways: a rounding for each of up to eight
    // factors.
    constexpr double kRegrouped = 8.0 * 0x1p-24;
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].sampled, b[i].sampled);
        for (int c = 0; c < 4; ++c) {
            EXPECT_NEAR(d(a[i].value[c]), d(b[i].value[c]), kRegrouped * d(b[i].value[c]));
            EXPECT_NEAR(d(a[i].weight[c]), d(b[i].weight[c]), kRegrouped * d(b[i].weight[c]));
        }
    }
}

}  // namespace
}  // namespace licht
