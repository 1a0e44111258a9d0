#pragma once
// The layers beside the picture, in one table: options, images on the device, what becomes of their sums, and
// channels of files follow from it.
#include <array>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace licht {

enum class LayerId : std::uint32_t {
    albedo,
    normal,
    depth,
    motion,
    variance,
    sample_count,
    bounces,
    unfiltered
};
inline constexpr std::size_t kLayerCount = 8;

/// How a layer is had from what the device keeps.
enum class LayerRule {
    mean,          ///< a sum, divided by the number of samples: it shares its edges with the picture
    mean_of_hits,  ///< a sum, divided by the number of samples that hit a surface
    direction,     ///< a sum, made unit; zero where there is none
    last,          ///< of the last sample
    picture,       ///< what the picture's own samples tell; no pass draws it
};

struct LayerInfo {
    LayerId id;
    std::string_view name;  ///< as it is asked for
    std::string_view meaning;
    /// In files; empty ones are none. Where a layer is several pictures, # stands for their numbers.
    std::array<std::string_view, 3> channels;
    LayerRule rule;
    std::string_view image;   ///< in the shaders; rule picture: none
    std::uint32_t component;  ///< of the image's texels, its first
    float missed;             ///< mean_of_hits: where nothing was hit

    [[nodiscard]] std::size_t channelCount() const;
};

/// In the order of their ids.
std::span<const LayerInfo> layerTable();
/// "albedo,normal,..."
std::string layerNames();

/// Images that passes draw layers into, each once.
std::vector<std::string_view> layerImages();
/// Where the samples that hit a surface are counted.
inline constexpr std::string_view kHitsImage = "aov_albedo";
inline constexpr std::uint32_t kHitsComponent = 3;

class LayerSet {
public:
    constexpr LayerSet() = default;
    constexpr LayerSet(std::initializer_list<LayerId> ids) {
        for (const LayerId id : ids) add(id);
    }
    constexpr void add(LayerId id) { bits_ |= bit(id); }
    [[nodiscard]] constexpr bool has(LayerId id) const { return (bits_ & bit(id)) != 0; }
    [[nodiscard]] constexpr bool empty() const { return bits_ == 0; }
    [[nodiscard]] constexpr LayerSet without(LayerId id) const {
        LayerSet rest = *this;
        rest.bits_ &= ~bit(id);
        return rest;
    }
    /// Whether a pass is called for.
    [[nodiscard]] bool anyDrawn() const;
    constexpr bool operator==(const LayerSet&) const = default;

private:
    static constexpr std::uint32_t bit(LayerId id) { return 1U << static_cast<std::uint32_t>(id); }
    std::uint32_t bits_ = 0;
};

LayerSet allLayers();

}  // namespace licht
