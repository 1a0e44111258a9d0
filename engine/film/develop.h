#pragma once
// From the device's history images to a Film.
#include <cstddef>
#include <span>

#include "licht/film/film.h"
#include "licht/settings/settings.h"

namespace licht {

/// The four history images (RGBA32F) of `samples` samples -> mean and variance of the mean.
void developBeauty(Film& film, std::span<const std::byte> mean_high, std::span<const std::byte> squares_high);

/// Sums over samples that hit a surface and the last one's motion, as aov.comp leaves them, of `aov_samples`
/// samples -> the layers asked for.
void developLayers(Film& film, const AovSet& wanted, std::uint32_t aov_samples,
                   std::span<const std::byte> albedo, std::span<const std::byte> normal,
                   std::span<const std::byte> motion);

}  // namespace licht
