#pragma once
#include <cassert>
#include <cstddef>
#include <vector>

namespace licht {

/// A plain value of linear floats, row-major from the top left, channels interleaved.
struct Image {
    int width = 0;
    int height = 0;
    int channels = 0;
    std::vector<float> texels;

    Image() = default;
    Image(int w, int h, int c)
        : width(w),
          height(h),
          channels(c),
          texels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h) * static_cast<std::size_t>(c)) {}

    [[nodiscard]] std::size_t index(int x, int y, int c) const {
        assert(x >= 0 && x < width && y >= 0 && y < height && c >= 0 && c < channels);
        return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
                   static_cast<std::size_t>(channels) +
               static_cast<std::size_t>(c);
    }
    [[nodiscard]] float& at(int x, int y, int c) { return texels[index(x, y, c)]; }
    [[nodiscard]] float at(int x, int y, int c) const { return texels[index(x, y, c)]; }
};

/// The first three of four channels.
inline Image withoutAlpha(const Image& rgba) {
    assert(rgba.channels == 4);
    Image rgb(rgba.width, rgba.height, 3);
    for (std::size_t i = 0; 3 * i < rgb.texels.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c) rgb.texels[3 * i + c] = rgba.texels[4 * i + c];
    return rgb;
}

}  // namespace licht
