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

/// Texels as stored in a PNG or JPEG, always four channels.
struct EncodedImage {
    int width = 0;
    int height = 0;
    int bits = 8;                     ///< 8 or 16 per channel
    std::vector<std::uint8_t> bytes;  ///< RGBA, 16 bit little-endian
};

/// Decodes PNG or JPEG bytes, judged by content. The header is read first: more than kMaxImageSide a side or
/// 2^28 texels is refused. Throws InputError with `name` and the reason.
EncodedImage decodeImage(std::span<const std::byte> bytes, const std::string& name);

}  // namespace licht
