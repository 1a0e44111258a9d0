#pragma once
// Pictures of one size side by side in one image, as shaders/pure/tiles.glsl finds them.
#include <cstdint>
#include <string_view>

#include "licht/core/math.h"
#include "licht/gpu/device.h"

namespace licht {

/// Columns and rows of an image that holds so many (at least one), RGBA32F. Throws InputError, with the
/// numbers, where the device has no image of that size; `what` the pictures are, `instead` what to ask for.
uvec2 tileGrid(const gpu::Device& device, uvec2 size, std::uint32_t tiles, std::string_view what,
               std::string_view instead);

}  // namespace licht
