#include "samples/licht/exr_layers.h"

#include <fmt/format.h>

#include <cassert>

namespace licht {
namespace {

/// Channels of the image, in order, under these names.
void addChannels(ExrPicture& picture, const Image& image, const std::vector<std::string>& names) {
    assert(image.width == picture.width && image.height == picture.height &&
           static_cast<std::size_t>(image.channels) >= names.size());
    const auto stride = static_cast<std::size_t>(image.channels);
    std::size_t offset = 0;
    for (const std::string& name : names) {
        ExrChannel channel{name, std::vector<float>(image.texels.size() / stride)};
        for (std::size_t pixel = 0; pixel < channel.values.size(); ++pixel)
            channel.values[pixel] = image.texels[pixel * stride + offset];
        picture.channels.push_back(std::move(channel));
        ++offset;
    }
}

}  // namespace

ExrPicture exrPicture(const Film& film, const Layers& layers,
                      std::vector<std::pair<std::string, std::string>> attributes) {
    ExrPicture picture;
    picture.width = static_cast<int>(film.size.x);
    picture.height = static_cast<int>(film.size.y);
    picture.attributes = std::move(attributes);
    addChannels(picture, film.mean, {"R", "G", "B", "A"});
    if (layers.aovs.albedo) addChannels(picture, film.albedo, {"albedo.R", "albedo.G", "albedo.B"});
    if (layers.aovs.normal) addChannels(picture, film.normal, {"N.X", "N.Y", "N.Z"});
    if (layers.aovs.depth) addChannels(picture, film.depth, {"Z"});
    if (layers.aovs.motion) addChannels(picture, film.motion, {"motion.X", "motion.Y"});
    if (layers.variance) addChannels(picture, film.variance, {"variance.R", "variance.G", "variance.B"});
    if (layers.sample_count)
        picture.channels.push_back(
            {"sampleCount", !film.counts.texels.empty()
                                ? film.counts.texels
                                : std::vector<float>(std::size_t{film.size.x} * film.size.y,
                                                     static_cast<float>(film.samples))});
    for (std::size_t i = 0; layers.orders && i < film.orders.size(); ++i) {
        const std::string name = fmt::format("bounces.{}", i);
        addChannels(picture, film.orders[i], {name + ".R", name + ".G", name + ".B"});
    }
    return picture;
}

}  // namespace licht
