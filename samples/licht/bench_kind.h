#pragma once
#include <functional>
#include <span>

#include "licht/bvh/bvh.h"
#include "licht/on_device/gpu_bvh.h"
#include "licht/probe/ray_recorder.h"
#include "samples/licht/bench_report.h"
#include "samples/yardstick/yardstick.h"

namespace licht {

/// One scene for the device, the host and Embree.
struct BenchScene {
    gpu::Device& device;
    const GpuBvh& on_device;
    std::span<const BvhTriangle> triangles;
    const Bvh& bvh;
    Yardstick* yardstick;  ///< null: Embree is not installed
    std::function<Yardstick&()>
        robust;  ///< the same triangles in Embree's robust mode; built when first asked for
};

/// Measures rays of one kind: device and Embree in turn, `runs` times. `run_done` is called after each of
/// them and once after warming up.
BenchKind measureKind(const BenchScene& scene, const RayList& list, std::uint32_t runs,
                      const std::function<void()>& run_done);

}  // namespace licht
