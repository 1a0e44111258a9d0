#pragma once
#include <array>
#include <optional>
#include <vector>

#include "licht/gpu/commands.h"
#include "licht/render/images.h"
#include "licht/render/in_flight.h"
#include "licht/render/programs.h"
#include "licht/render/scene_on_device.h"
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
    Frame(gpu::Device& device, const Programs& programs, const SceneOnDevice& scene,
          const RenderSettings& settings, const InFlight& in_flight, const gpu::Image* order_sums,
          const gpu::Buffer* tiles);

    /// The scene is another, with the same programs. Nothing may be in flight.
    void bind();
    /// A new frame: what the one before it wrote is the previous.
    void begin();
    /// The passes of a slice.
    void record(gpu::Commands& commands, std::size_t slot, const Slice& slice) const;
    /// Before everything of a new view whose scene is another: how far the light of the sample that was drawn
    /// last changed; where settings say that the scene moves.
    void recordGradients(gpu::Commands& commands, std::size_t slot, std::uint32_t last_sample) const;
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
        gpu::Bindings gbuffer, path, accumulate, layers, signals, reproject, edges, parts, gradient;
    };
    void followPaths(gpu::Commands& commands, std::size_t bound, const SamplePush& push) const;
    [[nodiscard]] std::vector<gpu::BoundResource> resources(std::size_t slot, std::size_t parity) const;
    [[nodiscard]] gpu::Threads pixels() const { return {images_.size().x, images_.size().y}; }

    gpu::Device& device_;
    const Programs& programs_;
    const SceneOnDevice& scene_;
    const RenderSettings& settings_;
    const InFlight& in_flight_;
    const gpu::Buffer* tiles_;
    Images images_;
    bool begun_ = false;
    std::optional<Wavefront> wavefront_;
    std::vector<Bound> bound_;            ///< per slot and parity of the images
    std::vector<gpu::Bindings> tonemap_;  ///< per parity
    std::optional<SpatialFilter> filter_;
    gpu::Bindings tonemap_filtered_;
    gpu::Bindings fold_, resolve_;
    std::array<gpu::Bindings, 2> spread_;  ///< from even to odd, and back
};

}  // namespace licht
