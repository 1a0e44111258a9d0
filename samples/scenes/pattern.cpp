#include "samples/scenes/pattern.h"

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace licht {
namespace {

/// PCG (Jarzynski and Olano, "Hash functions for GPU rendering", 2020).
std::uint32_t mix(std::uint32_t value) {
    const std::uint32_t state = value * 747796405U + 2891336453U;
    const std::uint32_t word = ((state >> ((state >> 28U) + 4U)) ^ state) * 277803737U;
    return (word >> 22U) ^ word;
}

std::uint8_t toByte(float value) {
    return static_cast<std::uint8_t>(std::lround(255.0F * glm::clamp(value, 0.0F, 1.0F)));
}

}  // namespace

float hashed(std::uint32_t x, std::uint32_t y, std::uint32_t seed) {
    // The upper 24 bits are a float's whole significand.
    return static_cast<float>(mix(x + mix(y + mix(seed))) >> 8U) * 0x1p-24F;
}

float valueNoise(const vec2& point, const uvec2& period, std::uint32_t seed) {
    const vec2 cell = glm::floor(point);
    const vec2 t = point - cell;
    const vec2 s = t * t * (3.0F - 2.0F * t);
    const auto wrapped = [](float c, std::uint32_t n) {
        const auto whole = static_cast<std::int64_t>(n);
        return static_cast<std::uint32_t>(((static_cast<std::int64_t>(c) % whole) + whole) % whole);
    };
    const std::uint32_t x0 = wrapped(cell.x, period.x);
    const std::uint32_t y0 = wrapped(cell.y, period.y);
    const std::uint32_t x1 = (x0 + 1) % period.x;
    const std::uint32_t y1 = (y0 + 1) % period.y;
    return glm::mix(glm::mix(hashed(x0, y0, seed), hashed(x1, y0, seed), s.x),
                    glm::mix(hashed(x0, y1, seed), hashed(x1, y1, seed), s.x), s.y);
}

float fractalNoise(const vec2& uv, const uvec2& cells, std::uint32_t octaves, std::uint32_t seed) {
    float sum = 0.0F;
    float weight = 0.5F;
    float total = 0.0F;
    uvec2 period = cells;
    for (std::uint32_t octave = 0; octave < octaves; ++octave) {
        sum += weight * valueNoise(uv * vec2(period), period, seed + octave);
        total += weight;
        weight *= 0.5F;
        period *= 2U;
    }
    return sum / total;
}

float softStep(float from, float to, float x) {
    const float t = glm::clamp((x - from) / (to - from), 0.0F, 1.0F);
    return t * t * (3.0F - 2.0F * t);
}

Texture paintTexture(std::string name, std::uint32_t width, std::uint32_t height,
                     const std::function<vec4(const vec2&)>& color) {
    Texture texture;
    texture.name = std::move(name);
    texture.width = width;
    texture.height = height;
    texture.bytes.reserve(std::size_t{4} * width * height);
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const vec2 uv = (vec2(x, y) + 0.5F) / vec2(width, height);
            const vec4 c = color(uv);
            for (int channel = 0; channel < 4; ++channel) texture.bytes.push_back(toByte(c[channel]));
        }
    }
    return texture;
}

Texture paintNormals(std::string name, std::uint32_t size, float slope,
                     const std::function<float(const vec2&)>& height) {
    std::vector<float> heights;
    heights.reserve(std::size_t{size} * size);
    for (std::uint32_t y = 0; y < size; ++y) {
        for (std::uint32_t x = 0; x < size; ++x)
            heights.push_back(height((vec2(x, y) + 0.5F) / static_cast<float>(size)));
    }
    const auto at = [&](std::uint32_t x, std::uint32_t y) {
        return heights[std::size_t{y % size} * size + x % size];
    };
    const float per_texel = 0.5F * static_cast<float>(size) * slope;
    return paintTexture(std::move(name), size, size, [&](const vec2& uv) {
        const auto x = static_cast<std::uint32_t>(uv.x * static_cast<float>(size));
        const auto y = static_cast<std::uint32_t>(uv.y * static_cast<float>(size));
        const float du = per_texel * (at(x + 1, y) - at(x + size - 1, y));
        const float dv = per_texel * (at(x, y + 1) - at(x, y + size - 1));
        // glTF's green points up in the picture, against v.
        const vec3 normal = glm::normalize(vec3(-du, dv, 1.0F));
        return vec4(0.5F * normal + 0.5F, 1.0F);
    });
}

Environment paintSky(std::string name, std::uint32_t width, std::uint32_t height,
                     const std::function<vec3(const vec3&, float)>& radiance) {
    Environment sky;
    sky.name = std::move(name);
    sky.radiance = Image(static_cast<int>(width), static_cast<int>(height), 3);
    for (int y = 0; y < sky.radiance.height; ++y) {
        const float polar = kPi * (static_cast<float>(y) + 0.5F) / static_cast<float>(height);
        for (int x = 0; x < sky.radiance.width; ++x) {
            const float longitude = (static_cast<float>(x) + 0.5F) / static_cast<float>(width);
            const float azimuth = 2.0F * kPi * (longitude - 0.5F);
            const vec3 direction{std::sin(polar) * std::sin(azimuth), std::cos(polar),
                                 -std::sin(polar) * std::cos(azimuth)};
            const vec3 texel = radiance(direction, longitude);
            for (int channel = 0; channel < 3; ++channel) sky.radiance.at(x, y, channel) = texel[channel];
        }
    }
    return sky;
}

}  // namespace licht
