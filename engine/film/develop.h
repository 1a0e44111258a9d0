#pragma once
// From the device's history images to a Film.
#include <cstddef>
#include <map>
#include <span>
#include <string_view>
#include <vector>

#include "licht/film/film.h"
#include "licht/settings/layers.h"

namespace licht {

/// The four history images (RGBA32F) of `samples` samples -> mean and variance of the mean.
void developBeauty(Film& film, std::span<const std::byte> mean_high, std::span<const std::byte> squares_high);

/// What the filter made of the picture, whose mean is developed: RGBA; and its estimated squared error, RGB,
/// with the squared bias in it, A.
void developFiltered(Film& film, std::span<const std::byte> filtered, std::span<const std::byte> error);

/// Images that passes drew layers into, by their names in the shaders: RGBA32F.
using LayerTexels = std::map<std::string_view, std::vector<std::byte>>;

/// What aov.comp left of `samples` samples -> the layers asked for, by the rules of their table.
void developLayers(Film& film, const LayerSet& wanted, std::uint32_t samples, const LayerTexels& images);

/// RGBA of [0,1], from texels of 8 bits a channel.
Image developDisplay(uvec2 size, std::span<const std::byte> texels);

}  // namespace licht
