#include "samples/licht/exr_layers.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <span>

namespace licht {
namespace {

/// Channels of the image, in order, under these names; # stands for the number.
void addChannels(ExrPicture& picture, const Image& image, std::span<const std::string_view> names,
                 std::size_t number = 0) {
    assert(image.width == picture.width && image.height == picture.height &&
           static_cast<std::size_t>(image.channels) >= names.size());
    const auto stride = static_cast<std::size_t>(image.channels);
    for (std::size_t offset = 0; offset < names.size(); ++offset) {
        std::string name(names[offset]);
        const std::size_t mark = name.find('#');
        if (mark != std::string::npos) name.replace(mark, 1, std::to_string(number));
        ExrChannel channel{std::move(name), std::vector<float>(image.texels.size() / stride)};
        for (std::size_t pixel = 0; pixel < channel.values.size(); ++pixel)
            channel.values[pixel] = image.texels[pixel * stride + offset];
        picture.channels.push_back(std::move(channel));
    }
}

Image countsOf(const Film& film) {
    if (!film.counts.texels.empty()) return film.counts;
    Image counts(static_cast<int>(film.size.x), static_cast<int>(film.size.y), 1);
    std::fill(counts.texels.begin(), counts.texels.end(), static_cast<float>(film.samples));
    return counts;
}

/// One picture, but of the layer that is one per order of light.
std::vector<Image> picturesOf(const Film& film, const LayerInfo& layer) {
    switch (layer.id) {
        case LayerId::variance:
            if (film.variance.texels.empty()) return {};
            return {film.variance};
        case LayerId::sample_count:
            return {countsOf(film)};
        case LayerId::bounces:
            return film.orders;
        case LayerId::unfiltered:
            return {film.unfiltered.texels.empty() ? film.mean : film.unfiltered};
        default:
            return {film.layer(layer.id)};
    }
}

}  // namespace

ExrPicture exrPicture(const Film& film, const LayerSet& layers,
                      std::vector<std::pair<std::string, std::string>> attributes) {
    ExrPicture picture;
    picture.width = static_cast<int>(film.size.x);
    picture.height = static_cast<int>(film.size.y);
    picture.attributes = std::move(attributes);
    constexpr std::array<std::string_view, 4> kPicture{"R", "G", "B", "A"};
    addChannels(picture, film.mean, kPicture);
    for (const LayerInfo& layer : layerTable()) {
        if (!layers.has(layer.id)) continue;
        const std::vector<Image> pictures = picturesOf(film, layer);
        for (std::size_t i = 0; i < pictures.size(); ++i)
            addChannels(picture, pictures[i], std::span(layer.channels).first(layer.channelCount()), i);
    }
    return picture;
}

}  // namespace licht
