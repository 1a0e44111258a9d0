#pragma once
// Rays on the device: the traversal of shaders/ray/traversal.glsl over a list of triangles.
#include <cstdint>
#include <optional>
#include <vector>

#include "licht/bvh/bvh.h"
#include "licht/gpu/program.h"
#include "licht/on_device/gpu_bvh.h"

namespace licht::test {

/// How a list of rays is traced.
struct TraceQuery {
    std::uint32_t ray_count = 0;  ///< filled in by Tracer
    float t_enough = 0.0F;        ///< see RayQuery: 0 the nearest hit, infinity any
    std::uint32_t refused = 0;    ///< positions in the leaves' order that this divides are no hits; 0: none
    std::uint32_t stride = 0;     ///< not 0: ray i accepts position i * stride alone
};

/// How rays share the device's lanes.
enum class Lanes { own, refilled };

/// Triangles and their BVH on the test device.
class Tracer {
public:
    /// Lanes::refilled is Lanes::own on devices that have no ballots.
    explicit Tracer(std::vector<BvhTriangle> triangles, bool in_storage = false, Lanes lanes = Lanes::own);

    [[nodiscard]] const std::vector<BvhTriangle>& triangles() const { return triangles_; }
    [[nodiscard]] const Bvh& bvh() const { return bvh_; }

    /// What each ray hits. Blocks.
    std::vector<std::optional<BvhHit>> trace(const std::vector<Ray>& rays, TraceQuery query = {});

    /// Traversals so far that the device did not finish; trace() gives no hit for them.
    [[nodiscard]] int truncated() const { return truncated_; }
    /// The same, as the program told it; counted where lanes are refilled.
    [[nodiscard]] int reported() const { return reported_; }
    [[nodiscard]] bool refills() const { return rays_per_thread_ > 1; }
    static constexpr std::uint32_t kRefills = 16;  ///< rays a thread where lanes are refilled
    /// What the device took for all rays so far.
    [[nodiscard]] double deviceSeconds() const { return device_seconds_; }

private:
    int truncated_ = 0;
    int reported_ = 0;
    std::uint32_t rays_per_thread_;
    double device_seconds_ = 0.0;
    std::vector<BvhTriangle> triangles_;
    Bvh bvh_;
    GpuBvh device_bvh_;
    gpu::Program program_;
};

}  // namespace licht::test
