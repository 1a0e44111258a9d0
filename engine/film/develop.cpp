#include "licht/film/develop.h"

#include <cassert>
#include <cmath>
#include <cstring>

namespace licht {
namespace {

std::size_t pixels(const Film& film) {
    return std::size_t{film.size.x} * film.size.y;
}

Image plane(const Film& film, int channels) {
    return {static_cast<int>(film.size.x), static_cast<int>(film.size.y), channels};
}

std::vector<vec4> texels(std::span<const std::byte> bytes) {
    std::vector<vec4> result(bytes.size() / sizeof(vec4));
    if (!result.empty()) std::memcpy(result.data(), bytes.data(), result.size() * sizeof(vec4));
    return result;
}

}  // namespace

void developBeauty(Film& film, std::span<const std::byte> mean_high,
                   std::span<const std::byte> squares_high) {
    const std::vector<vec4> mean = texels(mean_high);
    const std::vector<vec4> squares = texels(squares_high);
    film.mean = plane(film, 4);
    film.variance = plane(film, 3);
    const double n = film.samples;
    for (std::size_t i = 0; i < pixels(film); ++i) {
        for (int c = 0; c < 4; ++c) film.mean.texels[4 * i + static_cast<std::size_t>(c)] = mean[i][c];
        if (film.samples < 2) continue;
        for (int c = 0; c < 3; ++c)
            film.variance.texels[3 * i + static_cast<std::size_t>(c)] =
                static_cast<float>(std::max(static_cast<double>(squares[i][c]), 0.0) / (n * (n - 1.0)));
    }
}

void developLayers(Film& film, const AovSet& wanted, std::uint32_t aov_samples,
                   std::span<const std::byte> albedo_bytes, std::span<const std::byte> normal_bytes,
                   std::span<const std::byte> motion_bytes) {
    const std::vector<vec4> albedo = texels(albedo_bytes);
    const std::vector<vec4> normal = texels(normal_bytes);
    const std::vector<vec4> motion = texels(motion_bytes);
    if (wanted.albedo) film.albedo = plane(film, 3);
    if (wanted.normal) film.normal = plane(film, 3);
    if (wanted.depth) film.depth = plane(film, 1);
    if (wanted.motion) film.motion = plane(film, 2);
    for (std::size_t i = 0; i < pixels(film); ++i) {
        const float hits = albedo[i].w;
        // Albedo and beauty share their edges: both are means over all samples. Normal and depth are means
        // over what was hit, motion is that of the last sample.
        if (wanted.albedo) {
            const vec3 a = aov_samples > 0 ? vec3(albedo[i]) / static_cast<float>(aov_samples) : vec3(0.0F);
            std::memcpy(&film.albedo.texels[3 * i], &a, sizeof(a));
        }
        if (wanted.normal) {
            const vec3 sum(normal[i]);
            const float length = glm::length(sum);
            const vec3 n = length > 0.0F ? sum / length : vec3(0.0F);
            std::memcpy(&film.normal.texels[3 * i], &n, sizeof(n));
        }
        if (wanted.depth) film.depth.texels[i] = hits > 0.0F ? normal[i].w / hits : kInfinity;
        if (wanted.motion) {
            const vec2 m(motion[i]);
            std::memcpy(&film.motion.texels[2 * i], &m, sizeof(m));
        }
    }
}

}  // namespace licht
