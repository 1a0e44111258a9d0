#include "support/tracer.h"

#include <bit>
#include <cstring>
#include <span>

#include "licht/gpu/commands.h"
#include "licht/gpu/lanes.h"
#include "licht/shared/constants.h"
#include "licht/shared/index.h"
#include "licht/shared/ray_records.h"
#include "licht/spirv/tracer_comp.h"
#include "licht/spirv/tracer_refilled_comp.h"
#include "support/gpu_test.h"

namespace licht::test {
namespace {

constexpr std::uint32_t kTruncated = 0xfffffffeU;  // what stays in all words where the traversal was truncated

gpu::SpecConstants constantsOf(const GpuBvh& bvh, std::uint32_t rays_per_thread) {
    gpu::SpecConstants constants{{kConstantRaysPerThread, rays_per_thread}};
    bvh.addTo(constants);
    return constants;
}

}  // namespace

Tracer::Tracer(std::vector<BvhTriangle> triangles, bool in_storage, Lanes lanes)
    : rays_per_thread_(lanes == Lanes::refilled && hasBallots(gpu::testDevice()) ? kRefills : 1),
      triangles_(std::move(triangles)),
      bvh_(buildBvh(triangles_)),
      device_bvh_(gpu::testDevice(), bvh_.nodes, triangleTexels(bvh_, triangles_), bvh_.max_stack,
                  in_storage),
      program_(gpu::Program::compute(gpu::testDevice(), "tracer",
                                     refills() ? gpu::Spirv(tracer_refilled_comp) : gpu::Spirv(tracer_comp),
                                     constantsOf(device_bvh_, rays_per_thread_))) {}

std::vector<std::optional<BvhHit>> Tracer::trace(const std::vector<Ray>& rays, TraceQuery query) {
    std::vector<vec4> data;
    data.reserve(2 * rays.size());
    for (const Ray& ray : rays) {
        data.emplace_back(ray.origin, ray.t_min);
        data.emplace_back(ray.direction, ray.t_max);
    }
    gpu::Device& device = gpu::testDevice();
    const gpu::Buffer input =
        gpu::uploadBuffer(device, "rays", std::span<const vec4>(data), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    const std::vector<uvec4> all_truncated(rays.size(), uvec4(kTruncated));
    const gpu::Buffer output =
        gpu::uploadBuffer(device, "hits", std::span<const uvec4>(all_truncated),
                          VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    const gpu::Buffer truncated(device, "truncated", sizeof(std::uint32_t), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                           gpu::Memory::host_read);
    std::memset(truncated.mapped(), 0, sizeof(std::uint32_t));
    std::vector<gpu::BoundResource> resources{{"rays", &input}, {"hits", &output}, {"truncated", &truncated}};
    device_bvh_.addTo(resources);
    const gpu::Bindings bindings(device, program_, resources);
    query.ray_count = static_cast<std::uint32_t>(rays.size());
    gpu::Commands commands(device);
    commands.begin();
    const std::uint32_t threads = (query.ray_count + rays_per_thread_ - 1) / rays_per_thread_;
    commands.dispatch("trace", {program_, bindings}, query, {threads});
    const gpu::Buffer* told = &truncated;
    commands.makeVisibleToHost(std::span(&told, 1));
    commands.submit();
    commands.wait();
    for (const auto& [name, time] : commands.times()) {
        device_seconds_ += time.seconds;
    }

    std::uint32_t reported = 0;
    std::memcpy(&reported, truncated.mapped(), sizeof(reported));
    reported_ += static_cast<int>(reported);

    const std::vector<std::byte> bytes = gpu::readBuffer(device, output);
    std::vector<vec4> raw(rays.size());
    std::memcpy(raw.data(), bytes.data(), raw.size() * sizeof(vec4));
    std::vector<std::optional<BvhHit>> hits;
    hits.reserve(rays.size());
    for (const vec4& hit : raw) {
        const auto position = std::bit_cast<std::uint32_t>(hit.x);
        truncated_ += position == kTruncated ? 1 : 0;
        hits.push_back(position == kNoIndex || position == kTruncated
                           ? std::nullopt
                           : std::optional(BvhHit{bvh_.triangle_ids.at(position), hit.y, hit.z, hit.w}));
    }
    return hits;
}

}  // namespace licht::test
