#pragma once
// Primary hits by rasterising: frame + scene -> gbuffer, depth.
#include "licht/gpu/commands.h"
#include "licht/on_device/gpu_scene.h"
#include "licht/render/images.h"
#include "licht/shared/frame.h"

namespace licht {

gpu::Program gbufferProgram(gpu::Device& device, const gpu::SpecConstants& constants);

void recordGbuffer(gpu::Commands& commands, const gpu::BoundProgram& program, const GpuScene& scene,
                   const Images& images, const SamplePush& push);

}  // namespace licht
