#include "licht/render/gbuffer.h"

#include "licht/shared/index.h"
#include "licht/spirv/gbuffer_frag.h"
#include "licht/spirv/gbuffer_vert.h"

namespace licht {

gpu::Program gbufferProgram(gpu::Device& device, const gpu::SpecConstants& constants) {
    return gpu::Program::raster(device, "gbuffer", gbuffer_vert, gbuffer_frag,
                                {{VK_FORMAT_R32G32B32A32_UINT}, VK_FORMAT_D32_SFLOAT}, constants);
}

void recordGbuffer(gpu::Commands& commands, const gpu::BoundProgram& program, const GpuScene& scene,
                   const History& history, const SamplePush& push) {
    gpu::ColorTarget hits{&history.gbuffer, {}};
    hits.clear.uint32[0] = kNoIndex;
    commands.draw("gbuffer", program, push, {std::span(&hits, 1), &history.depth},
                  [&](VkCommandBuffer recording) {
                      for (const Draw& draw : scene.draws()) {
                          vkCmdSetCullMode(recording, draw.cull);
                          vkCmdDraw(recording, draw.vertex_count, draw.instance_count, draw.first_vertex,
                                    draw.first_instance);
                      }
                  });
}

}  // namespace licht
