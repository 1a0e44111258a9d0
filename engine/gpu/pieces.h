#pragma once
// Copies between host and device go in pieces: some drivers count a copy's bytes in 31 bits, and the memory
// between takes no more than a piece.
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "licht/gpu/resource.h"

namespace licht::gpu {

inline constexpr std::size_t kPieceBytes = std::size_t{64} << 20U;

/// Calls `copy(first, bytes)` for one piece after the other.
template <typename Copy>
void forEachPiece(std::size_t bytes, Copy copy) {
    for (std::size_t first = 0; first < bytes; first += kPieceBytes)
        copy(first, std::min(bytes - first, kPieceBytes));
}

/// Calls `copy(region, first, bytes)` for some whole rows after the others: the region of the image, and the
/// bytes that are its in tightly packed texels.
template <typename Copy>
void forEachPiece(const Image& image, Copy copy) {
    const VkExtent2D extent = image.extent();
    const std::size_t row_bytes = std::size_t{extent.width} * texelBytes(image.format());
    const auto most_rows = static_cast<std::uint32_t>(
        std::clamp<std::size_t>(kPieceBytes / row_bytes, 1, std::max(extent.height, 1U)));
    for (std::uint32_t row = 0; row < extent.height; row += most_rows) {
        const std::uint32_t rows = std::min(most_rows, extent.height - row);
        VkBufferImageCopy region{};
        region.imageSubresource = {image.aspect(), 0, 0, 1};
        region.imageOffset.y = static_cast<std::int32_t>(row);
        region.imageExtent = {extent.width, rows, 1};
        copy(region, row * row_bytes, rows * row_bytes);
    }
}

/// What a buffer between holds at most: a piece of so many bytes, or the longest row.
inline std::size_t largestPiece(std::size_t bytes) {
    return std::min(bytes, kPieceBytes);
}
inline std::size_t largestPiece(const Image& image) {
    std::size_t largest = 0;
    forEachPiece(image, [&](const VkBufferImageCopy&, std::size_t, std::size_t bytes) {
        largest = std::max(largest, bytes);
    });
    return largest;
}

}  // namespace licht::gpu
