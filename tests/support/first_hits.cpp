#include "support/first_hits.h"

#include <cstring>
#include <span>

#include "licht/gpu/commands.h"
#include "licht/on_device/gpu_scene.h"
#include "licht/render/gbuffer.h"
#include "licht/render/images.h"
#include "licht/render/view.h"
#include "licht/shared/effects.h"
#include "licht/shared/frame.h"
#include "support/gpu_test.h"

namespace licht {

std::vector<std::byte> lookAtFirstHits(const Scene& scene, uvec2 size, const std::string& name,
                                       gpu::Spirv kernel, std::size_t bytes) {
    gpu::Device& device = gpu::testDevice();
    Effects effects = detectEffects(scene);
    effects.on[kEffectAlpha] = false;
    const GpuScene gpu_scene(device, scene, effects, {});
    const Images images(device, size, {});
    gpu::SpecConstants constants = gpu_scene.constants();
    const gpu::Program gbuffer = gbufferProgram(device, constants);
    const gpu::Program program = gpu::Program::compute(device, name, kernel, constants);

    FrameRecord frame{};
    frame.view = makeView(scene.cameras[0], size, gpu_scene.bounds());
    frame.previous_view = frame.view;
    gpu_scene.describe(frame);
    gpu::Buffer frame_buffer(device, "frame", sizeof(frame), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                             gpu::Memory::host_write);
    std::memcpy(frame_buffer.mapped(), &frame, sizeof(frame));
    gpu::Buffer outcome(device, "outcome", bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::Memory::host_read);
    std::memset(outcome.mapped(), 0, bytes);
    std::vector<gpu::BoundResource> resources = gpu_scene.resources();
    for (const gpu::BoundResource& r : images.resources(0)) resources.push_back(r);
    resources.push_back({"FrameBlock", &frame_buffer});
    resources.push_back({"OutcomeBlock", &outcome});
    const gpu::Bindings gbuffer_bindings(device, gbuffer, resources);
    const gpu::Bindings bindings(device, program, resources);
    SamplePush push{};
    push.row_count = size.y;
    gpu::Commands commands(device);
    commands.begin();
    recordGbuffer(commands, {gbuffer, gbuffer_bindings}, gpu_scene, images, push);
    commands.dispatch(name, {program, bindings}, push, {size.x, size.y});
    const gpu::Buffer* visible = &outcome;
    commands.makeVisibleToHost(std::span(&visible, 1));
    commands.submit();
    commands.wait();
    std::vector<std::byte> result(bytes);
    std::memcpy(result.data(), outcome.mapped(), bytes);
    return result;
}

}  // namespace licht
