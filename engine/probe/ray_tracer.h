#pragma once
#include <span>
#include <vector>

#include "licht/gpu/commands.h"
#include "licht/on_device/gpu_bvh.h"
#include "licht/shared/ray_records.h"

namespace licht {

/// A list of rays on the device, to be traced as often as one likes. The tree must outlive it.
class RayTracer {
public:
    /// any_hit: the first hit that is found ends a ray. rays_per_thread: more than one, and lanes that are
    /// done take the next ray, which asks for subgroup ballots; see raysPerThread().
    RayTracer(gpu::Device& device, const GpuBvh& bvh, std::span<const RayRecord> rays, bool any_hit,
              uint rays_per_thread);

    /// Traces all rays and gives the seconds from the first submission to the end of the last one. The first
    /// call compiles on some drivers. Work is submitted in slices, so that no one runs long.
    double trace();
    /// What the last trace() hit, ray by ray. With any_hit, only whether `triangle` is kNoIndex says
    /// anything.
    [[nodiscard]] std::vector<RayHitRecord> hits() const;

private:
    void markAllTruncated();
    double traceRange(const RayRange& range);

    gpu::Device* device_;
    uint ray_count_;
    uint rays_per_thread_;
    uint slice_;
    gpu::Program program_;
    gpu::Buffer rays_;
    gpu::TexelView rays_view_;
    gpu::Buffer hits_, range_;
    gpu::Bindings bindings_;
    gpu::Commands commands_;
};

}  // namespace licht
