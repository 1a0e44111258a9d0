#include "licht/render/gbuffer.h"

#include "licht/render/pass_list.h"
#include "licht/shared/index.h"
#include "licht/spirv/gbuffer_frag.h"
#include "licht/spirv/gbuffer_vert.h"

namespace licht {

gpu::Program gbufferProgram(gpu::Device& device, const gpu::SpecConstants& constants) {
    return gpu::Program::raster(device, "gbuffer", gbuffer_vert, gbuffer_frag,
                                {{VK_FORMAT_R32G32B32A32_UINT}, VK_FORMAT_D32_SFLOAT}, constants);
}

void recordGbuffer(gpu::Commands& commands, const gpu::BoundProgram& program, const GpuScene& scene,
                   const Images& images, const SamplePush& push) {
    gpu::ColorTarget hits{&images["gbuffer"], {}};
    hits.clear.uint32[0] = kNoIndex;
    commands.draw(passName(PassId::gbuffer), program, push, {std::span(&hits, 1), &images["depth"]},
                  [&](VkCommandBuffer recording) {
                      for (const Draw& draw : scene.draws()) {
                          vkCmdSetCullMode(recording, draw.cull);
                          vkCmdDraw(recording, draw.vertex_count, draw.instance_count, draw.first_vertex,
                                    draw.first_instance);
                      }
                  });
}

}  // namespace licht
