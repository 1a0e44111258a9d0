// Pictures that tests of hard cases compare.
#pragma once
#include <cmath>
#include <cstring>
#include <string>

#include "licht/film/film.h"
#include "licht/settings/settings.h"
#include "samples/scenes/assembly.h"
#include "samples/scenes/shapes.h"
#include "support/render_test.h"

namespace licht::test {

inline RenderSettings picture(std::uint32_t side, std::uint32_t bounces) {
    RenderSettings settings;
    settings.size = uvec2(side);
    settings.bounces = bounces;
    settings.seed = 3;
    return settings;
}

inline bool identical(const Image& a, const Image& b) {
    return a.texels.size() == b.texels.size() &&
           std::memcmp(a.texels.data(), b.texels.data(), a.texels.size() * sizeof(float)) == 0;
}

inline float largestOf(const Image& image, int channel) {
    float largest = 0.0F;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            largest = std::max(largest, image.at(x, y, channel));
        }
    }
    return largest;
}

/// Peak signal-to-noise ratio in decibels against the reference's largest value; infinite for equal pictures.
inline double psnr(const Film& film, const Film& reference) {
    double squares = 0.0;
    double peak = 0.0;
    for (std::size_t i = 0; i < reference.mean.texels.size(); ++i) {
        const auto a = static_cast<double>(film.mean.texels[i]);
        const auto b = static_cast<double>(reference.mean.texels[i]);
        squares += (a - b) * (a - b);
        peak = std::max(peak, b);
    }
    return 10.0 * std::log10(peak * peak * static_cast<double>(reference.mean.texels.size()) / squares);
}

/// A light from above, a little to the side, without distance.
inline PunctualLight sun(float lux) {
    PunctualLight light;
    light.kind = PunctualLight::Kind::directional;
    light.intensity = vec3(lux);
    light.direction = glm::normalize(vec3(0.25F, -1.0F, -0.5F));
    return light;
}

/// Moves everything that has a place.
inline Scene moved(Scene scene, const vec3& shift) {
    for (licht::Mesh& mesh : scene.meshes) {
        for (vec3& p : mesh.positions) {
            p += shift;
        }
    }
    for (PunctualLight& light : scene.lights) {
        light.position += shift;
    }
    return scene;
}

inline Camera moved(Camera camera, const vec3& shift) {
    camera.world_from_view[3] += vec4(shift, 0.0F);
    return camera;
}

}  // namespace licht::test
