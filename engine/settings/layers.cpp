#include "licht/settings/layers.h"

#include <algorithm>
#include <array>
#include <limits>

namespace licht {
namespace {

constexpr float kInfinitelyFar = std::numeric_limits<float>::infinity();

constexpr std::array<LayerInfo, kLayerCount> kTable{{
    {LayerId::albedo,
     "albedo",
     "colour of the surface",
     {"albedo.R", "albedo.G", "albedo.B"},
     LayerRule::mean,
     "aov_albedo",
     0,
     0.0F},
    {LayerId::normal,
     "normal",
     "shading normal in world space",
     {"N.X", "N.Y", "N.Z"},
     LayerRule::direction,
     "aov_normal",
     0,
     0.0F},
    {LayerId::depth,
     "depth",
     "distance along the camera's axis in metres",
     {"Z"},
     LayerRule::mean_of_hits,
     "aov_normal",
     3,
     kInfinitelyFar},
    // A mean over samples would keep what is long past.
    {LayerId::motion,
     "motion",
     "pixels from where the sample before saw a point, zero once the camera has rested for a sample",
     {"motion.X", "motion.Y"},
     LayerRule::last,
     "aov_motion",
     0,
     0.0F},
    {LayerId::variance,
     "variance",
     "estimated variance of the picture's mean; of a filtered picture the squared error, bias included, "
     "where the filter says it",
     {"variance.R", "variance.G", "variance.B"},
     LayerRule::picture,
     "",
     0,
     0.0F},
    {LayerId::sample_count,
     "sampleCount",
     "samples of the pixel",
     {"sampleCount"},
     LayerRule::picture,
     "",
     0,
     0.0F},
    {LayerId::bounces,
     "bounces",
     "light by its number of bounces, a picture each",
     {"bounces.#.R", "bounces.#.G", "bounces.#.B"},
     LayerRule::picture,
     "",
     0,
     0.0F},
    {LayerId::unfiltered,
     "unfiltered",
     "mean of the samples, before --denoise",
     {"unfiltered.R", "unfiltered.G", "unfiltered.B"},
     LayerRule::picture,
     "",
     0,
     0.0F},
}};

constexpr bool inOrder() {
    for (std::size_t i = 0; i < kTable.size(); ++i)
        if (kTable[i].id != static_cast<LayerId>(i)) return false;
    return true;
}
static_assert(inOrder());

}  // namespace

std::size_t LayerInfo::channelCount() const {
    return static_cast<std::size_t>(std::count_if(channels.begin(), channels.end(),
                                                  [](std::string_view channel) { return !channel.empty(); }));
}

std::span<const LayerInfo> layerTable() {
    return kTable;
}

std::string layerNames() {
    std::string names;
    for (const LayerInfo& layer : kTable) {
        if (!names.empty()) names += ',';
        names += layer.name;
    }
    return names;
}

std::vector<std::string_view> layerImages() {
    std::vector<std::string_view> images;
    for (const LayerInfo& layer : kTable) {
        if (layer.rule == LayerRule::picture) continue;
        if (std::find(images.begin(), images.end(), layer.image) == images.end())
            images.push_back(layer.image);
    }
    return images;
}

bool LayerSet::anyDrawn() const {
    return std::any_of(kTable.begin(), kTable.end(), [this](const LayerInfo& layer) {
        return layer.rule != LayerRule::picture && has(layer.id);
    });
}

LayerSet allLayers() {
    LayerSet all;
    for (const LayerInfo& layer : kTable) all.add(layer.id);
    return all;
}

}  // namespace licht
