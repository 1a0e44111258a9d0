#include "licht/film/develop.h"

#include <cassert>
#include <cmath>
#include <cstring>

#include "licht/film/error_estimate.h"
#include "licht/measure/metrics.h"

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

vec3 finish(const LayerInfo& layer, const vec3& sum, float hits, std::uint32_t samples) {
    switch (layer.rule) {
        case LayerRule::mean:
            return samples > 0 ? sum / static_cast<float>(samples) : vec3(0.0F);
        case LayerRule::mean_of_hits:
            return hits > 0.0F ? sum / hits : vec3(layer.missed);
        case LayerRule::direction: {
            const float length = glm::length(sum);
            return length > 0.0F ? sum / length : vec3(0.0F);
        }
        case LayerRule::last:
        case LayerRule::picture:
            break;
    }
    return sum;
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

void developFiltered(Film& film, std::span<const std::byte> filtered, std::span<const std::byte> error) {
    const std::vector<vec4> picture = texels(filtered);
    const std::vector<vec4> squares = texels(error);
    film.unfiltered_error = relativeError(film);
    film.unfiltered = film.mean;
    double total = 0.0;
    for (std::size_t i = 0; i < pixels(film); ++i) {
        for (int c = 0; c < 4; ++c) film.mean.texels[4 * i + static_cast<std::size_t>(c)] = picture[i][c];
        for (int c = 0; c < 3; ++c) {
            film.variance.texels[3 * i + static_cast<std::size_t>(c)] = squares[i][c];
            total += static_cast<double>(picture[i][c]);
        }
    }
    const double mean = total / (3.0 * static_cast<double>(pixels(film)));
    double bias = 0.0;
    for (std::size_t i = 0; i < pixels(film); ++i)
        bias += relativeSquare(static_cast<double>(squares[i].w),
                               static_cast<double>(picture[i].x + picture[i].y + picture[i].z) / 3.0, mean);
    film.filter_bias = std::sqrt(bias / static_cast<double>(pixels(film)));
}

void developLayers(Film& film, const LayerSet& wanted, std::uint32_t samples, const LayerTexels& images) {
    const std::vector<vec4> hits = texels(images.at(kHitsImage));
    for (const LayerInfo& layer : layerTable()) {
        if (!wanted.has(layer.id) || layer.rule == LayerRule::picture) continue;
        const std::vector<vec4> sums = texels(images.at(layer.image));
        const auto channels = static_cast<int>(layer.channelCount());
        Image& developed = film.layer(layer.id);
        developed = plane(film, channels);
        for (std::size_t i = 0; i < pixels(film); ++i) {
            vec3 sum(0.0F);
            for (int c = 0; c < channels; ++c) sum[c] = sums[i][static_cast<int>(layer.component) + c];
            const vec3 value = finish(layer, sum, hits[i][static_cast<int>(kHitsComponent)], samples);
            for (int c = 0; c < channels; ++c)
                developed.texels[static_cast<std::size_t>(channels) * i + static_cast<std::size_t>(c)] =
                    value[c];
        }
    }
}

Image developDisplay(uvec2 size, std::span<const std::byte> texels) {
    Image picture(static_cast<int>(size.x), static_cast<int>(size.y), 4);
    for (std::size_t i = 0; i < picture.texels.size(); ++i)
        picture.texels[i] = static_cast<float>(texels[i]) / 255.0F;
    return picture;
}

}  // namespace licht
