// The same scene far from the origin gives the same picture.
#include <gtest/gtest.h>

#include <iostream>

#include "licht/film/film.h"
#include "licht/settings/settings.h"
#include "pictures.h"

namespace licht {
namespace {

/// Boxes of different emission and albedo on a floor; every coordinate is a multiple of 2^-6, which moving by
/// up to 2^17 keeps.
Scene boxes(bool lit) {
    Scene scene;
    for (int i = 0; i < 9; ++i) {
        scene.materials.push_back(
            lambert(0.1F * static_cast<float>(i), lit ? 0.0F : static_cast<float>(i + 1)));
    }
    place(scene, boxMesh("floor", 5, vec3(-4, -0.25F, -4), vec3(4, 0, 4)));
    for (std::uint32_t i = 0; i < 8; ++i) {
        const vec3 at(-3.0F + 1.5F * static_cast<float>(i % 4), 0.0F, i < 4 ? -1.25F : 1.5F);
        const float height = 0.5F + 0.25F * static_cast<float>(i);
        place(scene,
              boxMesh("box", i, at, at + vec3(0.75F + 0.015625F * static_cast<float>(i), height, 0.5F)));
    }
    if (lit) {
        PunctualLight lamp;
        lamp.position = vec3(1, 6, 3);
        lamp.intensity = vec3(40.0F);
        scene.lights.push_back(lamp);
        scene.environment = constantEnvironment(vec3(0.25F));
    }
    return scene;
}

Camera viewer() {
    return lookingCamera("viewer", vec3(5, 4, 7), vec3(0, 0.5F, 0), 0.9F);
}

vec3 shiftBy(int k) {
    return std::ldexp(1.0F, k) * vec3(1, -1, 1);
}

// What is seen: raster hits and emission.
TEST(Translation, WhatIsSeenIsTheSameTo2To10) {
    const Scene scene = boxes(false);
    const RenderSettings settings = test::picture(96, 0);
    const Film expected = renderFilm(scene, viewer(), settings, 2);
    EXPECT_GT(test::largestOf(expected.mean, 0), 1.0F);
    for (const int k : {0, 4, 7, 9, 10, 14, 17}) {
        const Film film =
            renderFilm(test::moved(scene, shiftBy(k)), test::moved(viewer(), shiftBy(k)), settings, 2);
        if (k <= 10) {
            EXPECT_TRUE(test::identical(film.mean, expected.mean)) << "2^" << k;
        }
        std::cout << "2^" << k << ": " << test::psnr(film, expected) << " dB\n";
    }
}

// With light: points on surfaces are rounded by their coordinates, so the last bits of a sample differ, and a
// ray at an edge may go another way.
TEST(Translation, LightIsNearlyTheSame) {
    const Scene scene = boxes(true);
    const RenderSettings settings = test::picture(64, 3);
    const Film expected = renderFilm(scene, viewer(), settings, 4);
    for (const int k : {5, 10, 15, 20}) {
        const Film film =
            renderFilm(test::moved(scene, shiftBy(k)), test::moved(viewer(), shiftBy(k)), settings, 4);
        const double decibel = test::psnr(film, expected);
        std::cout << "2^" << k << ": " << decibel << " dB\n";
        // Steps of the 8-bit display are 59 dB apart (20 log10(255) + 10.8): below that nobody sees it.
        if (k <= 10) {
            EXPECT_GT(decibel, 59.0) << "2^" << k;
        }
    }
}

}  // namespace
}  // namespace licht
