#pragma once
#include "licht/core/math.h"
#include "licht/gpu/commands.h"

namespace licht {

/// The images of one picture size. The accumulation pass alone owns what outlives a frame: means, squares and
/// layer sums.
struct History {
    /// Without layers their images do not exist.
    History(gpu::Device& device, uvec2 size, bool layers);

    [[nodiscard]] std::vector<gpu::BoundResource> resources() const;
    gpu::Image gbuffer, depth, radiance;
    gpu::Image mean_high, mean_low, squares_high, squares_low;
    gpu::Image aov_albedo, aov_normal, aov_motion;
    gpu::Image display;
    gpu::Image nothing;  ///< one texel for what programs name and, being specialised, never touch
    const gpu::Image* order_sums = nullptr;  ///< where they are kept; another owns it
    std::uint32_t samples = 0;
    std::uint32_t aov_samples = 0;
};

}  // namespace licht
