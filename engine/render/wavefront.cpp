#include "licht/render/wavefront.h"

#include <fmt/format.h>

#include <algorithm>

#include "licht/core/error.h"
#include "licht/gpu/lanes.h"
#include "licht/render/pass_list.h"
#include "licht/shared/constants.h"
#include "licht/shared/path.h"
#include "licht/shared/ray_records.h"
#include "licht/spirv/queue_finish_comp.h"
#include "licht/spirv/queue_prepare_comp.h"
#include "licht/spirv/queue_shade_comp.h"
#include "licht/spirv/queue_shadow_comp.h"
#include "licht/spirv/queue_start_comp.h"
#include "licht/spirv/queue_trace_comp.h"

namespace licht {
namespace {

constexpr std::uint32_t kTile = 8;
constexpr VkBufferUsageFlags kFetched =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;

std::uint32_t tiles(std::uint32_t pixels) {
    return (pixels + kTile - 1) / kTile;
}

}  // namespace

WavefrontPrograms::WavefrontPrograms(gpu::Device& device, const gpu::SpecConstants& constants,
                                     std::uint32_t most_bounces, std::uint32_t rays_per_thread)
    : bounces(most_bounces) {
    if (bounces > kMostQueueBounces)
        throw InputError(fmt::format("queues hold paths of at most {} bounces, {} were asked for",
                                     kMostQueueBounces, bounces));
    if (!offersBallots(device))
        throw InputError(
            fmt::format("queues need subgroup ballots, which '{}' does not have", device.report().name));
    if (!hasBallots(device))
        throw InputError(fmt::format("queues need subgroup ballots, but '{}' gets {} wrong",
                                     device.report().name, device.ballotTrouble()));
    gpu::SpecConstants with_lanes = constants;
    with_lanes[kConstantRaysPerThread] = rays_per_thread > 0 ? rays_per_thread : raysPerThread(device);
    const auto compile = [&](const char* name, gpu::Spirv spirv) {
        return gpu::Program::compute(device, name, spirv, with_lanes);
    };
    start = compile("queue_start", queue_start_comp);
    prepare = compile("queue_prepare", queue_prepare_comp);
    shade = compile("queue_shade", queue_shade_comp);
    shadow = compile("queue_shadow", queue_shadow_comp);
    trace = compile("queue_trace", queue_trace_comp);
    finish = compile("queue_finish", queue_finish_comp);
}

Wavefront::Wavefront(gpu::Device& device, const WavefrontPrograms& programs, uvec2 size)
    : device_(&device), programs_(&programs), width_(size.x) {
    // A slice's paths; a dispatch over them stays within the device's workgroups and its buffers.
    const VkPhysicalDeviceLimits& limits = device.limits();
    const std::uint64_t tile_row = std::uint64_t{tiles(size.x)} * kTile * kTile;
    const std::uint64_t most_paths =
        std::min({std::uint64_t{limits.maxComputeWorkGroupCount[0]} * kQueueGroup,
                  std::uint64_t{limits.maxTexelBufferElements} / kPathTexels,
                  std::uint64_t{limits.maxStorageBufferRange} / (kPathTexels * sizeof(uvec4))});
    const auto tile_rows = static_cast<std::uint32_t>(
        std::clamp(most_paths / tile_row, std::uint64_t{1}, std::uint64_t{tiles(size.y)}));
    most_rows_ = tile_rows * kTile;
    const std::uint64_t paths = tile_row * tile_rows;

    const auto buffer = [&](const char* name, std::uint64_t bytes, VkBufferUsageFlags usage) {
        return gpu::Buffer(device, name, bytes, usage, gpu::Memory::device);
    };
    counts_ =
        buffer("queue counts", std::uint64_t{queueCountAt(programs.bounces + 2, 0)} * sizeof(std::uint32_t),
               VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    groups_ = buffer("queue groups", kQueues * sizeof(uvec4),
                     VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT);
    paths_ = buffer("queue paths", paths * kPathTexels * sizeof(uvec4), kFetched);
    hits_ = buffer("queue hits", paths * sizeof(std::uint32_t), kFetched);
    rays_ = buffer("queue rays", paths * kRayTexels * sizeof(uvec4), kFetched);
    shadows_ = buffer("queue shadows", paths * kShadowTexels * sizeof(uvec4), kFetched);
    paths_view_ = gpu::TexelView(device, paths_, VK_FORMAT_R32G32B32A32_UINT);
    hits_view_ = gpu::TexelView(device, hits_, VK_FORMAT_R32_UINT);
    rays_view_ = gpu::TexelView(device, rays_, VK_FORMAT_R32G32B32A32_UINT);
    shadows_view_ = gpu::TexelView(device, shadows_, VK_FORMAT_R32G32B32A32_UINT);
}

void Wavefront::bind(std::vector<gpu::BoundResource> resources) {
    resources.insert(resources.end(), {{"QueueCounts", &counts_},
                                       {"QueueGroups", &groups_},
                                       {"QueuePaths", &paths_},
                                       {"QueueHits", &hits_},
                                       {"QueueRays", &rays_},
                                       {"QueueShadows", &shadows_},
                                       {"queue_path_texels", &paths_view_},
                                       {"queue_hit_texels", &hits_view_},
                                       {"queue_ray_texels", &rays_view_},
                                       {"queue_shadow_texels", &shadows_view_}});
    const auto to = [&](const gpu::Program& program) { return gpu::Bindings(*device_, program, resources); };
    bound_.push_back({to(programs_->start), to(programs_->prepare), to(programs_->shade),
                      to(programs_->shadow), to(programs_->trace), to(programs_->finish)});
}

void Wavefront::record(gpu::Commands& commands, std::size_t bound, bool by_bounce,
                       const SamplePush& sample) const {
    const WavefrontPrograms& run = *programs_;
    const BoundKernels& on = bound_[bound];
    WavefrontPush push{sample.sample_index, sample.first_row, sample.row_count, 0};
    const gpu::Threads pixels{width_, push.row_count};
    const auto overQueue = [&](PassId pass, const gpu::BoundProgram& kernel, std::uint32_t queue) {
        commands.dispatchIndirect(by_bounce ? passName(pass, push.bounce) : passName(pass), kernel, push,
                                  groups_, queue * sizeof(uvec4));
    };
    const auto prepare = [&] {
        commands.dispatch(passName(PassId::path_prepare), {run.prepare, on.prepare}, push, {1});
    };

    commands.pass(passName(PassId::path_clear), {{&counts_, gpu::Access::transfer_write}},
                  [&](VkCommandBuffer recording) {
                      vkCmdFillBuffer(recording, counts_.handle(), 0, VK_WHOLE_SIZE, 0);
                  });
    commands.dispatch(passName(PassId::path_start), {run.start, on.start}, push, pixels);
    for (push.bounce = 0; push.bounce <= run.bounces; ++push.bounce) {
        prepare();
        overQueue(PassId::path_shade, {run.shade, on.shade}, kCountHits);
        if (push.bounce == run.bounces) break;
        prepare();
        overQueue(PassId::path_shadow, {run.shadow, on.shadow}, kCountShadows);
        overQueue(PassId::path_trace, {run.trace, on.trace}, kCountRays);
    }
    commands.dispatch(passName(PassId::path_finish), {run.finish, on.finish}, push, pixels);
}

}  // namespace licht
