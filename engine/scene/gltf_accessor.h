#pragma once
// Accessors as plain arrays: bounds, component types, strides, normalisation and sparse overrides are dealt
// with here alone.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "licht/core/math.h"
#include "licht/scene/gltf_asset.h"

namespace licht::gltf {

/// Accessors without bytes of their own (all zero, but for sparse ones) are believed up to so many elements.
inline constexpr std::size_t kMostImpliedElements = std::size_t{1} << 24U;

/// Elements of the accessor. `object` names who asks, for errors. All throw InputError when the accessor is
/// damaged or of another shape.
std::vector<vec2> readVec2(const Asset& asset, int accessor, std::string_view object);
std::vector<vec3> readVec3(const Asset& asset, int accessor, std::string_view object);
std::vector<vec4> readVec4(const Asset& asset, int accessor, std::string_view object);
std::vector<mat4> readMat4(const Asset& asset, int accessor, std::string_view object);

/// VEC3 or VEC4; a missing fourth component is 1.
std::vector<vec4> readColors(const Asset& asset, int accessor, std::string_view object);

/// Unsigned integers: SCALAR for indices, VEC4 for joints.
std::vector<std::uint32_t> readIndices(const Asset& asset, int accessor, std::string_view object);
std::vector<uvec4> readJoints(const Asset& asset, int accessor, std::string_view object);

}  // namespace licht::gltf
