#pragma once
// Rays on the device: the traversal of shaders/bound/traversal.glsl over a list of triangles.
#include <cstdint>
#include <optional>
#include <vector>

#include "licht/bvh/bvh.h"
#include "licht/gpu/program.h"
#include "licht/render/gpu_bvh.h"

namespace licht::test {

/// How a list of rays is traced.
struct TraceQuery {
    std::uint32_t ray_count = 0;  ///< filled in by Tracer
    std::uint32_t any_hit = 0;
    std::uint32_t refused = 0;  ///< positions in the leaves' order that this divides are no hits; 0: none
    std::uint32_t stride = 0;   ///< not 0: ray i accepts position i * stride alone
};

/// Triangles and their BVH on the test device.
class Tracer {
public:
    explicit Tracer(std::vector<BvhTriangle> triangles, bool in_storage = false);

    [[nodiscard]] const std::vector<BvhTriangle>& triangles() const { return triangles_; }
    [[nodiscard]] const Bvh& bvh() const { return bvh_; }

    /// What each ray hits. Blocks.
    std::vector<std::optional<BvhHit>> trace(const std::vector<Ray>& rays, TraceQuery query = {});

    /// Walks so far that the device did not finish; trace() gives no hit for them.
    [[nodiscard]] int cutWalks() const { return cut_walks_; }
    /// What the device took for all rays so far.
    [[nodiscard]] double deviceSeconds() const { return device_seconds_; }

private:
    int cut_walks_ = 0;
    double device_seconds_ = 0.0;
    std::vector<BvhTriangle> triangles_;
    Bvh bvh_;
    GpuBvh device_bvh_;
    gpu::Program program_;
};

}  // namespace licht::test
