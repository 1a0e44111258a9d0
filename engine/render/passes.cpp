#include "licht/render/passes.h"

#include "licht/shared/frame.h"
#include "licht/shared/index.h"

namespace licht {

using gpu::Access;

void recordGbuffer(gpu::Commands& commands, const gpu::Program& program, const gpu::Bindings& bindings,
                   const GpuScene& scene, const History& history, const SamplePush& push) {
    commands.pass("gbuffer",
                  {{&history.gbuffer, Access::color_target}, {&history.depth, Access::depth_target}},
                  [&](const gpu::Pass& pass) {
                      gpu::ColorTarget target{&history.gbuffer, {}};
                      target.clear.uint32[0] = kNoIndex;
                      pass.render(std::span(&target, 1), &history.depth, [&] {
                          pass.bind(program, bindings);
                          pass.push(program, std::as_bytes(std::span(&push, 1)));
                          for (const Draw& draw : scene.draws()) {
                              vkCmdSetCullMode(pass.commandBuffer(), draw.cull);
                              vkCmdDraw(pass.commandBuffer(), draw.vertex_count, draw.instance_count,
                                        draw.first_vertex, draw.first_instance);
                          }
                      });
                  });
}

void recordPath(gpu::Commands& commands, const gpu::Program& program, const gpu::Bindings& bindings,
                const History& history, const gpu::Buffer& counters, const SamplePush& push,
                std::uint32_t paths_per_thread) {
    const VkExtent2D extent = history.gbuffer.extent();
    std::vector<gpu::Use> uses{{&history.gbuffer, Access::compute_read},
                               {&history.radiance, Access::compute_write},
                               {&counters, Access::compute_read_write},
                               history.orderSumsUse()};
    commands.pass("path", uses, [&](const gpu::Pass& pass) {
        pass.dispatch(program, bindings, push, extent.width,
                      (push.row_count + paths_per_thread - 1) / paths_per_thread);
    });
}

void recordAccumulate(gpu::Commands& commands, const gpu::Program& program, const gpu::Bindings& bindings,
                      const History& history, const SamplePush& push) {
    commands.pass("accumulate",
                  {{&history.radiance, Access::compute_read},
                   {&history.mean_high, Access::compute_read_write},
                   {&history.mean_low, Access::compute_read_write},
                   {&history.squares_high, Access::compute_read_write},
                   {&history.squares_low, Access::compute_read_write}},
                  [&](const gpu::Pass& pass) {
                      pass.dispatch(program, bindings, push, history.radiance.extent().width,
                                    history.radiance.extent().height);
                  });
}

void recordLayers(gpu::Commands& commands, const gpu::Program& program, const gpu::Bindings& bindings,
                  const History& history, const SamplePush& push) {
    commands.pass("layers",
                  {{&history.gbuffer, Access::compute_read},
                   {&history.aov_albedo, Access::compute_read_write},
                   {&history.aov_normal, Access::compute_read_write},
                   {&history.aov_motion, Access::compute_read_write}},
                  [&](const gpu::Pass& pass) {
                      pass.dispatch(program, bindings, push, history.gbuffer.extent().width,
                                    history.gbuffer.extent().height);
                  });
}

void recordTonemap(gpu::Commands& commands, const gpu::Program& program, const gpu::Bindings& bindings,
                   const gpu::Image& mean, const History& history, const TonemapPush& push) {
    commands.pass("tonemap", {{&mean, Access::compute_read}, {&history.display, Access::compute_write}},
                  [&](const gpu::Pass& pass) {
                      pass.dispatch(program, bindings, push, history.display.extent().width,
                                    history.display.extent().height);
                  });
}

}  // namespace licht
