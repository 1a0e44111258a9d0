#pragma once
#include <span>
#include <vector>

#include "licht/gpu/commands.h"
#include "licht/shared/frame.h"

namespace licht {

/// The estimator of path.comp as small kernels with queues between them (Laine, Karras, Aila 2013,
/// Megakernels Considered Harmful: Wavefront Path Tracing on GPUs): bit for bit the same samples.
struct WavefrontPrograms {
    /// Throws InputError for more than kMostQueueBounces bounces. rays_per_thread: 0 as raysPerThread() says.
    WavefrontPrograms(gpu::Device& device, const gpu::SpecConstants& constants, std::uint32_t bounces,
                      std::uint32_t rays_per_thread);

    std::uint32_t bounces;
    gpu::Program start, prepare, shade, shadow, trace, finish;
};

/// The queues for slices of pictures of one size, and what the programs are bound to.
class Wavefront {
public:
    Wavefront(gpu::Device& device, const WavefrontPrograms& programs, uvec2 size);

    /// One more set of resources that record() may choose: those of the scene, the images and the frame.
    void bind(std::vector<gpu::BoundResource> resources);
    /// Before other resources take the place of those.
    void unbind() { bound_.clear(); }

    /// The passes of a slice, bound to the resources that came in that place. `by_bounce`: timed by the
    /// bounce, so that each order of light has its time.
    void record(gpu::Commands& commands, std::size_t bound, bool by_bounce, const SamplePush& sample) const;

    /// Rows that a slice may have.
    [[nodiscard]] std::uint32_t mostRows() const { return most_rows_; }

private:
    struct BoundKernels {
        gpu::Bindings start, prepare, shade, shadow, trace, finish;
    };
    gpu::Device* device_;
    const WavefrontPrograms* programs_;
    std::uint32_t width_;
    std::uint32_t most_rows_;
    gpu::Buffer counts_, groups_, paths_, hits_, rays_, shadows_;
    gpu::TexelView paths_view_, hits_view_, rays_view_, shadows_view_;
    std::vector<BoundKernels> bound_;
};

}  // namespace licht
