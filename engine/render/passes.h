#pragma once
// The passes of a frame. Each is a function that records one pass: what it reads, what it writes, what it
// runs.
#include "licht/gpu/commands.h"
#include "licht/on_device/gpu_scene.h"
#include "licht/render/history.h"
#include "licht/shared/frame.h"

namespace licht {

/// Primary hits by rasterising: frame constants + scene -> gbuffer, depth.
void recordGbuffer(gpu::Commands& commands, const gpu::Program& program, const gpu::Bindings& bindings,
                   const GpuScene& scene, const History& history, const SamplePush& push);

/// Rows [push.first_row, + push.row_count): gbuffer -> radiance, and counts.
void recordPath(gpu::Commands& commands, const gpu::Program& program, const gpu::Bindings& bindings,
                const History& history, const gpu::Buffer& counters, const SamplePush& push,
                std::uint32_t paths_per_thread);

/// radiance -> mean and variance.
void recordAccumulate(gpu::Commands& commands, const gpu::Program& program, const gpu::Bindings& bindings,
                      const History& history, const SamplePush& push);

/// gbuffer -> sums of albedo, normal, depth, motion.
void recordLayers(gpu::Commands& commands, const gpu::Program& program, const gpu::Bindings& bindings,
                  const History& history, const SamplePush& push);

/// `mean`, which the bindings name, -> display.
void recordTonemap(gpu::Commands& commands, const gpu::Program& program, const gpu::Bindings& bindings,
                   const gpu::Image& mean, const History& history, const TonemapPush& push);

}  // namespace licht
