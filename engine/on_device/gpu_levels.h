#pragma once
#include <vector>

#include "licht/gpu/program.h"
#include "licht/on_device/flat_geometry.h"
#include "licht/on_device/gpu_bvh.h"
#include "licht/on_device/uploads.h"
#include "licht/settings/settings.h"
#include "licht/shared/index.h"

namespace licht {

/// The BVH of baked triangles and instanced meshes on the device, and where its instances stand.
class GpuLevels {
public:
    GpuLevels() = default;
    GpuLevels(Uploads& uploads, const FlatGeometry& geometry, BvhQuality quality, bool storage);

    void addTo(std::vector<gpu::BoundResource>& resources, const gpu::Buffer& none) const;
    void addTo(gpu::SpecConstants& constants) const;
    /// Of the instances.
    [[nodiscard]] const Bounds& topBounds() const { return top_bounds_; }
    /// Empty where there is no instance.
    [[nodiscard]] const gpu::Buffer& transforms() const { return instance_transforms_; }
    [[nodiscard]] double buildSeconds() const { return build_seconds_; }
    [[nodiscard]] std::uint32_t dropped() const { return dropped_; }

private:
    gpu::Buffer instance_transforms_;
    GpuBvh bvh_;
    Bounds top_bounds_;
    uint baked_instances_ = kNoIndex;
    uint first_instance_position_ = kNoIndex;
    uint first_instance_texel_ = 0;
    float instance_slack_ = 0.0F;
    double build_seconds_ = 0.0;
    std::uint32_t dropped_ = 0;
};

}  // namespace licht
