#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "licht/colour/primaries.h"
#include "licht/image/image.h"

namespace licht {

/// One channel plane of an EXR file under the ecosystem's name ("R", "albedo.R", "N.X", "Z", ...), width *
/// height floats.
struct ExrChannel {
    std::string name;
    std::vector<float> values;
};

/// A part of the plane, in texels of a picture.
struct PictureWindow {
    std::int64_t x = 0;  ///< of its upper left texel
    std::int64_t y = 0;
    int width = 0;
    int height = 0;
};

/// A flat single-part scanline EXR: float channels, and string attributes that say how it was made.
struct ExrPicture {
    int width = 0;
    int height = 0;
    std::vector<ExrChannel> channels;
    std::vector<std::pair<std::string, std::string>> attributes;
    PictureWindow display;               ///< what is to be shown, seen from the first texel that is stored
    std::optional<Primaries> primaries;  ///< of red, green and blue, where the file says them

    /// The channel of that name, or nullptr.
    [[nodiscard]] const ExrChannel* find(const std::string& name) const;
};

/// Writes 32-bit float channels, ZIP compressed, with the Rec. 709 chromaticities; complete or not at all.
/// Throws InputError when the place is not writable, DeviceError when writing fails.
void writeExr(const std::filesystem::path& path, const ExrPicture& picture);

/// Reads every channel of a flat single-part file as float. Throws InputError naming file and reason:
/// truncated, deep, multi-part, larger than kMaxImageSide a side or kMaxImageTexels, chroma-subsampled, or
/// more than memory holds.
ExrPicture readExr(const std::filesystem::path& path);

inline constexpr int kMaxImageSide = 32768;
inline constexpr std::int64_t kMaxImageTexels = std::int64_t{1} << 28U;

}  // namespace licht
