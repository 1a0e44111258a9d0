#pragma once
// What procedural pictures are made of: a hash, periodic noise, soft edges, and texels from a function.
#include <cstdint>
#include <functional>
#include <string>

#include "licht/scene/scene.h"

namespace licht {

/// Uniform in [0, 1), the same on every machine.
float hashed(std::uint32_t x, std::uint32_t y, std::uint32_t seed);

/// Smooth noise in [0, 1] with one random value at each lattice point; it repeats after `period` lattice
/// points.
float valueNoise(const vec2& point, const uvec2& period, std::uint32_t seed);

/// A sum of octaves of valueNoise over [0,1)^2 with `cells` lattice points at first, in [0, 1]; it tiles.
float fractalNoise(const vec2& uv, const uvec2& cells, std::uint32_t octaves, std::uint32_t seed);

/// 0 below `from`, 1 above `to`, smooth between.
float softStep(float from, float to, float x);

/// One RGBA colour in [0,1] for each texel's centre (u, v), eight bits per channel.
Texture paintTexture(std::string name, std::uint32_t width, std::uint32_t height,
                     const std::function<vec4(const vec2& uv)>& color);

/// A tangent-space normal map of a height field that tiles; `slope` is the height of 1 in units of the
/// picture's width.
Texture paintNormals(std::string name, std::uint32_t size, float slope,
                     const std::function<float(const vec2& uv)>& height);

/// A latitude-longitude sky of the radiance towards each texel's centre (unit direction), in cd/m^2.
Environment paintSky(std::string name, std::uint32_t width, std::uint32_t height,
                     const std::function<vec3(const vec3& direction, float longitude)>& radiance);

}  // namespace licht
