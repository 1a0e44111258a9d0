#pragma once
// Pictures in and out by file ending, for all formats but the layers of EXR (exr.h).
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "licht/image/image.h"

namespace licht {

/// Writes display-referred values in [0,1] (already transfer-encoded; 1, 3 or 4 channels) as an 8-bit PNG,
/// complete or not at all.
void writePng(const std::filesystem::path& path, const Image& picture);

/// Whether a file is a PNG that writePng() wrote: it carries the text "Software: Licht".
bool isOwnPng(const std::filesystem::path& path);

/// A radiance map: .hdr (Radiance RGBE) or .exr, three channels of linear Rec. 709. Non-finite or negative
/// values become 0; *replaced counts the texels that had one. Throws InputError naming file and reason.
Image readRadianceMap(const std::filesystem::path& path, std::size_t* replaced = nullptr);

/// What the header of a PNG or JPEG says.
struct ImageShape {
    int width = 0;
    int height = 0;
    int bits = 8;  ///< 8 or 16 per channel

    /// As decodeImage() gives them.
    [[nodiscard]] std::size_t bytes() const {
        return std::size_t{4} * static_cast<std::size_t>(bits / 8) * static_cast<std::size_t>(width) *
               static_cast<std::size_t>(height);
    }
};

/// Reads the header of PNG or JPEG bytes, judged by content. More than kMaxImageSide a side or
/// kMaxImageTexels is refused. Throws InputError with `name` and the reason.
ImageShape shapeOfImage(std::span<const std::byte> bytes, const std::string& name);

/// Texels as stored in a PNG or JPEG, always four channels.
struct EncodedImage {
    int width = 0;
    int height = 0;
    int bits = 8;                     ///< 8 or 16 per channel
    std::vector<std::uint8_t> bytes;  ///< RGBA, 16 bit little-endian
};

/// Decodes PNG or JPEG bytes whose header shapeOfImage() takes. Throws InputError with `name` and the reason.
EncodedImage decodeImage(std::span<const std::byte> bytes, const std::string& name);

}  // namespace licht
