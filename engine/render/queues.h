#pragma once
#include <array>
#include <span>
#include <vector>

#include "licht/gpu/commands.h"
#include "licht/shared/frame.h"

namespace licht {

/// The estimator of path.comp as small kernels with queues between them (Laine, Karras, Aila 2013,
/// Megakernels Considered Harmful: Wavefront Path Tracing on GPUs): bit for bit the same samples.
class Queues {
public:
    /// For slices of pictures of this size. Throws InputError for more than kMostQueueBounces bounces.
    /// rays_per_thread: 0 as raysPerThread() says.
    Queues(gpu::Device& device, const gpu::SpecConstants& constants, uvec2 size, std::uint32_t bounces,
           std::uint32_t rays_per_thread);

    /// `resources`: of the scene, the history and the frame. `counters`: per slot.
    void bind(gpu::Device& device, const std::vector<gpu::BoundResource>& resources,
              std::span<const gpu::Buffer* const> counters);

    /// The passes of a slice, their names beginning with "path". Timed by the bounce, each order of light has
    /// its time.
    void record(gpu::Commands& commands, std::uint32_t width, bool timed_by_bounce, std::size_t slot,
                const SamplePush& sample) const;

    /// Rows that a dispatch may span.
    [[nodiscard]] std::uint32_t mostRows() const { return most_rows_; }

private:
    struct Kernel {
        gpu::Program program;
        std::vector<gpu::Bindings> bindings;  ///< per slot
    };
    Kernel start_, prepare_, shade_, shadow_, trace_, finish_;
    gpu::Buffer counts_, groups_, paths_, hits_, rays_, shadows_;
    gpu::TexelView paths_view_, hits_view_, rays_view_, shadows_view_;
    std::uint32_t bounces_;
    std::uint32_t most_rows_;
};

}  // namespace licht
