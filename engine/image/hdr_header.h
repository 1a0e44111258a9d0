#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "licht/colour/primaries.h"

namespace licht {

/// What a Radiance file says of its numbers (Ward 1992, Real Pixels; the format's description in "Radiance
/// File Formats", Lawrence Berkeley National Laboratory).
struct HdrHeader {
    glm::dvec3 divisor{1.0};  ///< the product of all EXPOSURE and COLORCORR: radiance is the number over it
    std::optional<Primaries> primaries;  ///< PRIMARIES
};

/// Reads the header. Throws InputError naming the file where the numbers are not RGB (32-bit_rle_rgbe), the
/// rows do not go from the top left (-Y +X), or a factor is no positive number.
HdrHeader readHdrHeader(std::span<const std::byte> bytes, const std::string& name);

}  // namespace licht
