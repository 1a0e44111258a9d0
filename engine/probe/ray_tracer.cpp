#include "licht/probe/ray_tracer.h"

#include <algorithm>
#include <cstring>

#include "licht/core/clock.h"
#include "licht/shared/constants.h"
#include "licht/spirv/trace_rays_comp.h"
#include "licht/spirv/trace_rays_refilled_comp.h"

namespace licht {
namespace {

// Long enough that the cost of a submission (about 0.1 ms) is not seen, short enough for every watchdog.
constexpr double kSliceSeconds = 0.25;
constexpr uint kFirstSlice = 1U << 14U;
// 65,535 workgroups of 64 are what every device runs at once.
constexpr uint kLargestSlice = 1U << 21U;

gpu::SpecConstants constantsOf(const GpuBvh& bvh, bool any_hit, uint rays_per_thread) {
    gpu::SpecConstants constants{{kConstantAnyHit, any_hit ? 1U : 0U},
                                 {kConstantRaysPerThread, rays_per_thread}};
    bvh.addTo(constants);
    return constants;
}

std::vector<gpu::BoundResource> with(const GpuBvh& bvh, std::vector<gpu::BoundResource> resources) {
    bvh.addTo(resources);
    return resources;
}

}  // namespace

RayTracer::RayTracer(gpu::Device& device, const GpuBvh& bvh, std::span<const RayRecord> rays, bool any_hit,
                     uint rays_per_thread)
    : device_(&device),
      ray_count_(static_cast<uint>(rays.size())),
      rays_per_thread_(rays_per_thread),
      slice_(kFirstSlice),
      program_(gpu::Program::compute(
          device, any_hit ? "trace_rays any" : "trace_rays nearest",
          rays_per_thread > 1 ? gpu::Spirv(trace_rays_refilled_comp) : gpu::Spirv(trace_rays_comp),
          constantsOf(bvh, any_hit, rays_per_thread))),
      rays_(gpu::uploadBuffer(device, "rays", rays, VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT)),
      rays_view_(device, rays_, VK_FORMAT_R32G32B32A32_SFLOAT),
      hits_(device, "ray hits", rays.size() * sizeof(RayHitRecord),
            VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                VK_BUFFER_USAGE_TRANSFER_DST_BIT,
            gpu::Memory::device),
      range_(device, "ray range", sizeof(RayRange), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
             gpu::Memory::host_write),
      bindings_(device, program_,
                with(bvh, {{"Range", &range_}, {"ray_texels", &rays_view_}, {"RayHits", &hits_}})),
      commands_(device) {}

double RayTracer::traceRange(const RayRange& range) {
    std::memcpy(range_.mapped(), &range, sizeof(range));
    const Clock::time_point start = Clock::now();
    commands_.begin();
    const uint threads = (range.count + rays_per_thread_ - 1) / rays_per_thread_;
    commands_.dispatch("trace_rays", {program_, bindings_}, {threads});
    commands_.submit();
    commands_.wait();
    return secondsSince(start);
}

// Rays whose traversal is truncated write nothing.
void RayTracer::markAllTruncated() {
    commands_.begin();
    commands_.pass("mark", {{&hits_, gpu::Access::transfer_write}}, [&](VkCommandBuffer recording) {
        vkCmdFillBuffer(recording, hits_.handle(), 0, VK_WHOLE_SIZE, kRayTruncated);
    });
    commands_.submit();
    commands_.wait();
}

double RayTracer::trace() {
    markAllTruncated();
    double seconds = 0.0;
    uint slice = 0;
    for (RayRange range{0, 0}; range.first < ray_count_; range.first += slice) {
        slice = std::min(slice_, ray_count_ - range.first);
        range.count = slice;
        const double needed = traceRange(range);
        seconds += needed;
        // At most twice as many at once: rays further on may cost more.
        const double fitting = kSliceSeconds / needed * slice;
        slice_ =
            static_cast<uint>(std::clamp(fitting, 1024.0, std::min(2.0 * slice_, double{kLargestSlice})));
    }
    return seconds;
}

std::vector<RayHitRecord> RayTracer::hits() const {
    const std::vector<std::byte> bytes = gpu::readBuffer(*device_, hits_);
    std::vector<RayHitRecord> records(ray_count_);
    std::memcpy(records.data(), bytes.data(), records.size() * sizeof(RayHitRecord));
    return records;
}

}  // namespace licht
