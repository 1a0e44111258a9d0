#include "licht/probe/ray_recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "licht/core/error.h"
#include "licht/gpu/commands.h"
#include "licht/render/gbuffer.h"
#include "licht/render/images.h"
#include "licht/render/view.h"
#include "licht/shared/choices.h"
#include "licht/shared/constants.h"
#include "licht/shared/effects.h"
#include "licht/shared/frame.h"
#include "licht/spirv/record_rays_comp.h"

namespace licht {
namespace {

constexpr std::uint32_t kTile = 8;  // record_rays.comp's workgroup
constexpr std::uint32_t kPixelsPerSubmission = 1U << 16U;

constexpr std::array<const char*, kRayLists> kListNames{"PrimaryRays",      "FirstShadowRays",
                                                        "FirstBounceRays",  "SecondShadowRays",
                                                        "SecondBounceRays", "GlossyRays"};

gpu::SpecConstants constantsOf(const GpuScene& scene) {
    gpu::SpecConstants constants = scene.constants();
    constants[kEffectGlossy] = 0;  // diffuse bounces
    constants[kEffectIridescence] = 0;
    constants[kConstantDirect] = kDirectMis;
    return constants;
}

FrameRecord frameOf(const GpuScene& scene, const Camera& camera, uvec2 size) {
    FrameRecord frame{};
    frame.view = makeView(camera, size, scene.bounds());
    frame.previous_view = frame.view;
    frame.bounces = kRecordedBounces;
    frame.roulette_start = kRecordedBounces;
    scene.describe(frame);
    return frame;
}

// The rays that are there, in order.
void append(std::vector<RayRecord>& rays, gpu::Device& device, const gpu::Buffer& list) {
    const std::vector<std::byte> bytes = gpu::readBuffer(device, list);
    for (std::size_t at = 0; at + sizeof(RayRecord) <= bytes.size(); at += sizeof(RayRecord)) {
        RayRecord ray;
        std::memcpy(&ray, bytes.data() + at, sizeof(ray));
        if (ray.t_max >= ray.t_min) rays.push_back(ray);
    }
}

}  // namespace

std::vector<RayList> recordRays(gpu::Device& device, const GpuScene& scene, const Camera& camera,
                                uvec2 size) {
    const std::uint64_t tiles = std::uint64_t{(size.x + kTile - 1) / kTile} * ((size.y + kTile - 1) / kTile);
    const std::uint64_t list_bytes = tiles * kTile * kTile * sizeof(RayRecord);
    // The longest list, shadow, is two of these, and is read as texels.
    const std::uint64_t limit =
        std::min(std::uint64_t{device.limits().maxStorageBufferRange},
                 std::uint64_t{device.limits().maxTexelBufferElements} * sizeof(vec4)) /
        2;
    if (list_bytes > limit)
        throw InputError(
            fmt::format("{}x{} pixels are too many rays for this device's buffers: at most {} pixels", size.x,
                        size.y, limit / sizeof(RayRecord)));

    const gpu::SpecConstants constants = constantsOf(scene);
    const gpu::Program gbuffer = gbufferProgram(device, constants);
    const gpu::Program record = gpu::Program::compute(device, "record_rays", record_rays_comp, constants);
    const Images images(device, size, {});
    const gpu::Buffer frame_buffer(device, "frame", sizeof(FrameRecord), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                   gpu::Memory::host_write);
    const FrameRecord frame = frameOf(scene, camera, size);
    std::memcpy(frame_buffer.mapped(), &frame, sizeof(frame));

    std::vector<gpu::BoundResource> resources = scene.resources();
    for (const gpu::BoundResource& r : images.resources(0)) resources.push_back(r);
    resources.push_back({"FrameBlock", &frame_buffer});
    std::vector<gpu::Buffer> lists;
    for (const char* name : kListNames)
        lists.emplace_back(device, name, list_bytes,
                           VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                           gpu::Memory::device);
    for (std::size_t i = 0; i < kRayLists; ++i) resources.push_back({kListNames[i], &lists[i]});
    const gpu::Bindings gbuffer_bindings(device, gbuffer, resources);
    const gpu::Bindings record_bindings(device, record, resources);

    const std::uint32_t rows = std::max(1U, kPixelsPerSubmission / size.x / kTile) * kTile;
    gpu::Commands commands(device);
    SamplePush push{};
    for (push.first_row = 0; push.first_row < size.y; push.first_row += rows) {
        push.row_count = std::min(rows, size.y - push.first_row);
        commands.begin();
        if (push.first_row == 0) recordGbuffer(commands, {gbuffer, gbuffer_bindings}, scene, images, push);
        commands.dispatch("record_rays", {record, record_bindings}, push, {size.x, push.row_count});
        commands.submit();
        commands.wait();
    }

    std::vector<RayList> kinds{{"primary", false, {}},
                               {"shadow", true, {}},
                               {"bounce1", false, {}},
                               {"bounce2", false, {}},
                               {"glossy", false, {}}};
    append(kinds[0].rays, device, lists[kRaysPrimary]);
    append(kinds[1].rays, device, lists[kRaysFirstShadow]);
    append(kinds[1].rays, device, lists[kRaysSecondShadow]);
    append(kinds[2].rays, device, lists[kRaysFirstBounce]);
    append(kinds[3].rays, device, lists[kRaysSecondBounce]);
    append(kinds[4].rays, device, lists[kRaysGlossy]);
    return kinds;
}

}  // namespace licht
