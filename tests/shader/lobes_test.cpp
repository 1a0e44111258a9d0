// What holds of every lobe (lobe_test.h), of each and of their layers.
#include <gtest/gtest.h>

#include <cstdint>

#include "licht/spirv/lobes_comp.h"
#include "lobe_test.h"

namespace licht {
namespace {

struct Parameters {
    vec3 diffuse{0.0F};
    float alpha = 0.3F;
    vec3 f0{0.0F};
    float f90 = 0.0F;
    float thickness = 0.0F;
    std::uint32_t lobe = 2;
    float metallic = 0.0F;
};

TEST(Lobes, AreReciprocalSampledByTheirDensityAndGainNothing) {
    const std::pair<const char*, Parameters> lobes[]{
        {"diffuse", {.diffuse = vec3(0.9F, 0.5F, 0.1F), .lobe = 0}},
        {"narrow specular", {.alpha = 0.25F, .f0 = vec3(1.0F), .f90 = 1.0F, .lobe = 1}},
        {"wide specular", {.alpha = 1.0F, .f0 = vec3(0.9F, 0.5F, 0.2F), .f90 = 1.0F, .lobe = 1}},
        {"specular over diffuse", {.diffuse = vec3(1.0F), .f0 = vec3(0.04F), .f90 = 1.0F}},
        {"rough metal", {.alpha = 1.0F, .f0 = vec3(1.0F, 0.7F, 0.3F), .f90 = 1.0F, .metallic = 1.0F}},
        {"metal", {.alpha = 0.3F, .f0 = vec3(1.0F, 0.7F, 0.3F), .f90 = 1.0F, .metallic = 1.0F}},
        {"half a metal over diffuse",
         {.diffuse = vec3(0.5F), .alpha = 0.6F, .f0 = vec3(0.5F), .f90 = 1.0F, .metallic = 0.5F}},
        {"thin film over diffuse",
         {.diffuse = vec3(1.0F), .f0 = vec3(0.04F), .f90 = 1.0F, .thickness = 300.0F}},
    };
    test::Kernel kernel("lobes", lobes_comp);
    constexpr double kMostGain = 0.001;  // that the fits add, see energy_test.cpp
    for (const auto& [name, parameters] : lobes) {
        const test::Lobe lobe(kernel, name, parameters);
        if (parameters.thickness == 0.0F) lobe.expectReciprocal();
        for (const double cosine : {1.0, 0.5, 0.2}) {
            lobe.expectSamplesFollowDensity(test::towards(cosine), static_cast<int>(std::size(lobes) * 3));
            lobe.expectNoGain(test::towards(cosine), kMostGain);
        }
    }
}

}  // namespace
}  // namespace licht
