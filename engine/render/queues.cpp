#include "licht/render/queues.h"

#include <fmt/format.h>

#include <algorithm>

#include "licht/core/error.h"
#include "licht/gpu/lanes.h"
#include "licht/shared/constants.h"
#include "licht/shared/queue_records.h"
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
// The rays before a shadow ray share a word with its target: the rasteriser's, and two a bounce.
static_assert(1 + 2 * kMostQueueBounces < 1U << kShadowTargetShift);
constexpr VkBufferUsageFlags kFetched =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;

std::uint32_t tiles(std::uint32_t pixels) {
    return (pixels + kTile - 1) / kTile;
}

}  // namespace

Queues::Queues(gpu::Device& device, const gpu::SpecConstants& constants, uvec2 size, std::uint32_t bounces,
               std::uint32_t rays_per_thread)
    : bounces_(bounces) {
    if (bounces > kMostQueueBounces)
        throw InputError(fmt::format("queues hold paths of at most {} bounces, {} were asked for",
                                     kMostQueueBounces, bounces));
    if (!hasBallots(device))
        throw InputError(
            fmt::format("queues need subgroup ballots, which '{}' does not have", device.report().name));
    gpu::SpecConstants with_lanes = constants;
    with_lanes[kConstantRaysPerThread] = rays_per_thread > 0 ? rays_per_thread : raysPerThread(device);
    const auto compile = [&](const char* name, gpu::Spirv spirv) {
        return Kernel{gpu::Program::compute(device, name, spirv, with_lanes), {}};
    };
    start_ = compile("queue_start", queue_start_comp);
    prepare_ = compile("queue_prepare", queue_prepare_comp);
    shade_ = compile("queue_shade", queue_shade_comp);
    shadow_ = compile("queue_shadow", queue_shadow_comp);
    trace_ = compile("queue_trace", queue_trace_comp);
    finish_ = compile("queue_finish", queue_finish_comp);

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
    counts_ = buffer("queue counts", std::uint64_t{kQueueCounts} * (bounces + 2) * sizeof(std::uint32_t),
                     VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    groups_ = buffer("queue groups", kQueueCounts * sizeof(uvec4),
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

void Queues::bind(gpu::Device& device, const std::vector<gpu::BoundResource>& resources,
                  std::span<const gpu::Buffer* const> counters) {
    for (Kernel* kernel : {&start_, &prepare_, &shade_, &shadow_, &trace_, &finish_}) {
        kernel->bindings.clear();
        for (const gpu::Buffer* own : counters) {
            std::vector<gpu::BoundResource> all = resources;
            all.insert(all.end(), {{"Counters", own},
                                   {"QueueCounts", &counts_},
                                   {"QueueGroups", &groups_},
                                   {"QueuePaths", &paths_},
                                   {"QueueHits", &hits_},
                                   {"QueueRays", &rays_},
                                   {"QueueShadows", &shadows_},
                                   {"queue_path_texels", &paths_view_},
                                   {"queue_hit_texels", &hits_view_},
                                   {"queue_ray_texels", &rays_view_},
                                   {"queue_shadow_texels", &shadows_view_}});
            kernel->bindings.emplace_back(device, kernel->program, all);
        }
    }
}

void Queues::record(gpu::Commands& commands, std::uint32_t width, bool timed_by_bounce, std::size_t slot,
                    const SamplePush& sample) const {
    QueuePush push{sample.sample_index, sample.first_row, sample.row_count, 0};
    const auto bound = [slot](const Kernel& kernel) {
        return gpu::BoundProgram{kernel.program, kernel.bindings[slot]};
    };
    const gpu::Threads pixels{width, push.row_count};
    const auto overQueue = [&](const char* name, const Kernel& kernel, std::uint32_t which) {
        const std::string timed =
            timed_by_bounce ? fmt::format("{} {}", name, push.bounce) : std::string(name);
        commands.dispatchIndirect(timed, bound(kernel), push, groups_, which * sizeof(uvec4));
    };
    const auto prepare = [&] { commands.dispatch("path prepare", bound(prepare_), push, {1}); };

    commands.pass("path clear", {{&counts_, gpu::Access::transfer_write}}, [&](VkCommandBuffer recording) {
        vkCmdFillBuffer(recording, counts_.handle(), 0, VK_WHOLE_SIZE, 0);
    });
    commands.dispatch("path start", bound(start_), push, pixels);
    for (push.bounce = 0; push.bounce <= bounces_; ++push.bounce) {
        prepare();
        overQueue("path shade", shade_, kCountHits);
        if (push.bounce == bounces_) break;
        prepare();
        overQueue("path shadow", shadow_, kCountShadows);
        overQueue("path trace", trace_, kCountRays);
    }
    commands.dispatch("path finish", bound(finish_), push, pixels);
}

}  // namespace licht
