#include "licht/render/images.h"

#include <algorithm>
#include <cassert>

#include "licht/render/tiles.h"
#include "licht/shared/signals.h"

namespace licht {
namespace {

constexpr VkFormat kFloat4 = VK_FORMAT_R32G32B32A32_SFLOAT;

bool wantsLayers(const RenderSettings& settings) {
    return settings.layers.anyDrawn();
}

bool wantsSignals(const RenderSettings& settings) {
    return keepsSignals(settings);
}

bool wantsHistory(const RenderSettings& settings) {
    return keepsHistory(settings);
}

bool wantsGradients(const RenderSettings& settings) {
    return keepsHistory(settings) && settings.scene_moves;
}

/// Whole texels.
uvec2 shrunk(uvec2 size, std::uint32_t by) {
    return {(size.x + by - 1) / by, (size.y + by - 1) / by};
}

constexpr auto kTable = std::to_array<ImageRow>({
    {"gbuffer", VK_FORMAT_R32G32B32A32_UINT, Target::color, Lifetime::frame, nullptr},
    {"depth", VK_FORMAT_D32_SFLOAT, Target::depth, Lifetime::frame, nullptr},
    {"radiance_image", kFloat4, Target::none, Lifetime::frame, nullptr},
    {"mean_high", kFloat4, Target::none, Lifetime::history, nullptr},
    {"mean_low", kFloat4, Target::none, Lifetime::history, nullptr},
    {"squares_high", kFloat4, Target::none, Lifetime::history, nullptr},
    {"squares_low", kFloat4, Target::none, Lifetime::history, nullptr},
    {"order_sums", kFloat4, Target::none, Lifetime::lent, nullptr},
    {"sample_signals", kFloat4, Target::none, Lifetime::frame, wantsSignals, kSampleTiles},
    {"signal_sums", kFloat4, Target::none, Lifetime::history, wantsSignals, kSumTiles},
    {"history", kFloat4, Target::none, Lifetime::history, wantsHistory, kHistoryTiles},
    {"prior", kFloat4, Target::none, Lifetime::history, wantsHistory, kPriorTiles},
    {"gradients_even", kFloat4, Target::none, Lifetime::frame, wantsGradients, 1, kGradientSide},
    {"gradients_odd", kFloat4, Target::none, Lifetime::frame, wantsGradients, 1, kGradientSide},
    {"edge_parts", VK_FORMAT_R32_SFLOAT, Target::none, Lifetime::history, wantsHistory, kEdgeTiles},
    {"unresolved", kFloat4, Target::none, Lifetime::frame, wantsHistory},
    {"unresolved_error", kFloat4, Target::none, Lifetime::frame, wantsHistory},
    {"filter_guide", kFloat4, Target::none, Lifetime::frame, wantsSignals, kGuideTiles},
    {"filter_even", kFloat4, Target::none, Lifetime::frame, wantsSignals, kFilterTiles},
    {"filter_odd", kFloat4, Target::none, Lifetime::frame, wantsSignals, kFilterTiles},
    {"smooth_even", kFloat4, Target::none, Lifetime::frame, wantsSignals},
    {"smooth_odd", kFloat4, Target::none, Lifetime::frame, wantsSignals},
    {"filtered", kFloat4, Target::none, Lifetime::frame, wantsSignals},
    {"filtered_error", kFloat4, Target::none, Lifetime::frame, wantsSignals},
    {"display_image", VK_FORMAT_R8G8B8A8_UNORM, Target::none, Lifetime::frame, nullptr},
});

VkImageUsageFlags usageOf(Target target) {
    constexpr VkImageUsageFlags kStored = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    switch (target) {
        case Target::none:
            return kStored;
        case Target::color:
            return kStored | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
        case Target::depth:
            break;
    }
    return VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
}

}  // namespace

std::span<const ImageRow> imageTable() {
    static const std::vector<ImageRow> kWithLayers = [] {
        std::vector<ImageRow> table(kTable.begin(), kTable.end());
        for (const std::string_view image : layerImages())
            table.push_back({image, kFloat4, Target::none, Lifetime::history, wantsLayers});
        return table;
    }();
    return kWithLayers;
}

double bytesOfPicture(uvec2 size, const RenderSettings& settings, std::span<const ImageRow> table) {
    // Film, layers and files as they are made of what is read back: measured, tests/bench/MEASURED.md,
    // "Memory".
    constexpr double kHostBytes = 80.0;
    constexpr double kHostBytesOfImage = 25.0;
    constexpr double kBytesOfRounds = 50.0;
    double bytes = kHostBytes;
    for (const ImageRow& row : table) {
        if (row.lifetime == Lifetime::lent || (row.wanted != nullptr && !row.wanted(settings))) continue;
        bytes += row.tiles * gpu::texelBytes(row.format) * (row.lifetime == Lifetime::ping_pong ? 2.0 : 1.0);
        if (row.wanted != nullptr && row.tiles == 1) bytes += kHostBytesOfImage;
    }
    if (settings.adaptive) bytes += kBytesOfRounds;
    return bytes * size.x * size.y;
}

Images::Images(gpu::Device& device, uvec2 size, const RenderSettings& settings,
               std::span<const ImageRow> table)
    : size_(size), nothing_(device, "nothing", {1, 1}, kFloat4, usageOf(Target::none)) {
    for (const ImageRow& row : table) {
        Entry& entry = entries_.emplace_back();
        entry.row = &row;
        entry.previous_name = "previous_" + std::string(row.name);
        if (row.lifetime == Lifetime::lent || (row.wanted != nullptr && !row.wanted(settings))) continue;
        const uvec2 grid = row.tiles == 1 ? uvec2(1)
                                          : tileGrid(device, size, row.tiles, "pictures for the filter",
                                                     "a smaller picture or --denoise none");
        const uvec2 extent = grid * shrunk(size, row.shrink);
        const bool pair = row.lifetime == Lifetime::ping_pong;
        pairs_ = pairs_ || pair;
        for (std::size_t i = 0; i < (pair ? 2U : 1U); ++i)
            entry.images[i] = gpu::Image(device, std::string(row.name), {extent.x, extent.y}, row.format,
                                         usageOf(row.target));
    }
}

const gpu::Image& Images::imageOf(const Entry& entry, std::size_t parity) const {
    if (entry.lent != nullptr) return *entry.lent;
    if (!entry.images[0]) return nothing_;
    return entry.row->lifetime == Lifetime::ping_pong ? entry.images[parity % 2] : entry.images[0];
}

const gpu::Image& Images::operator[](std::string_view name) const {
    const auto found = std::find_if(entries_.begin(), entries_.end(),
                                    [name](const Entry& entry) { return entry.row->name == name; });
    assert(found != entries_.end());
    return imageOf(*found, parity());
}

void Images::lend(std::string_view name, const gpu::Image& image) {
    const auto found = std::find_if(entries_.begin(), entries_.end(),
                                    [name](const Entry& entry) { return entry.row->name == name; });
    assert(found != entries_.end() && found->row->lifetime == Lifetime::lent);
    found->lent = &image;
}

std::vector<gpu::BoundResource> Images::resources(std::size_t parity) const {
    std::vector<gpu::BoundResource> list;
    for (const Entry& entry : entries_) {
        list.push_back({std::string(entry.row->name), &imageOf(entry, parity)});
        if (entry.row->lifetime == Lifetime::ping_pong)
            list.push_back({entry.previous_name, &imageOf(entry, parity + 1)});
    }
    return list;
}

}  // namespace licht
