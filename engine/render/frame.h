#pragma once
#include <optional>
#include <vector>

#include "licht/gpu/commands.h"
#include "licht/on_device/gpu_scene.h"
#include "licht/render/images.h"
#include "licht/render/in_flight.h"
#include "licht/render/programs.h"
#include "licht/render/spatial_filter.h"
#include "licht/render/wavefront.h"
#include "licht/settings/settings.h"
#include "licht/shared/frame.h"

namespace licht {

/// Rows of a frame that one submission draws.
struct Slice {
    SamplePush push{};
    bool first = true;  ///< of the frame's
    bool last = true;
};

/// What a frame of one picture size reads and writes, and its passes.
class Frame {
public:
    /// `order_sums`, `tiles`: where they are kept, else null. All must outlive it.
    Frame(gpu::Device& device, const Programs& programs, const GpuScene& scene,
          const RenderSettings& settings, const InFlight& in_flight, const gpu::Image* order_sums,
          const gpu::Buffer* tiles);

    /// A new frame: what the one before it wrote is the previous.
    void begin();
    /// The passes of a slice.
    void record(gpu::Commands& commands, std::size_t slot, const Slice& slice) const;
    /// Before the first pass of a new view's first sample: keeps what the view before has told, by so many
    /// samples; where settings keep a history.
    void recordFold(gpu::Commands& commands, const HalfCounts& counts) const;
    /// Behind the passes of a new view's first sample: brings that to what it shows.
    void recordReproject(gpu::Commands& commands, std::size_t slot, const ReprojectPush& push) const;
    /// Makes "filtered" and "filtered_error"; where settings keep signals.
    void recordFilter(gpu::Commands& commands, const HalfCounts& counts, bool orthographic) const;
    /// From the mean so far, or what the filter made of it, to what a display shows.
    void recordDisplay(gpu::Commands& commands, const TonemapPush& push, bool filtered = false) const;
    /// Whether the frame behind that many samples draws the layers.
    [[nodiscard]] bool drawsLayers(std::uint32_t count_before) const;

    [[nodiscard]] const Images& images() const { return images_; }
    /// Rows that a slice may have.
    [[nodiscard]] std::uint32_t mostRows() const;

private:
    struct Bound {
        gpu::Bindings gbuffer, path, accumulate, layers, signals, reproject, edges, parts;
    };
    void followPaths(gpu::Commands& commands, std::size_t bound, const SamplePush& push) const;
    [[nodiscard]] gpu::Threads pixels() const { return {images_.size().x, images_.size().y}; }

    const Programs& programs_;
    const GpuScene& scene_;
    const RenderSettings& settings_;
    Images images_;
    bool begun_ = false;
    std::optional<Wavefront> wavefront_;
    std::vector<Bound> bound_;            ///< per slot and parity of the images
    std::vector<gpu::Bindings> tonemap_;  ///< per parity
    std::optional<SpatialFilter> filter_;
    gpu::Bindings tonemap_filtered_;
    gpu::Bindings fold_, resolve_;
};

}  // namespace licht
