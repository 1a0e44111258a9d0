#include "samples/licht/bench_kind.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>

#include "licht/gpu/lanes.h"
#include "licht/probe/ray_tracer.h"
#include "samples/licht/bench_compare.h"

namespace licht {
namespace {

constexpr std::size_t kCountedRays = 20'000;  // steps are counted on the host for about so many

double mraysPerSecond(std::size_t rays, double seconds) {
    return static_cast<double>(rays) / seconds * 1e-6;
}

/// What all threads of this process have computed for.
double processSeconds() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

// Steps of the host's twin of the traversal, over rays spread evenly across the list.
void countSteps(const BenchScene& scene, const RayList& list, BenchKind& result) {
    const std::size_t stride = std::max<std::size_t>(1, list.rays.size() / kCountedRays);
    std::uint64_t rays = 0;
    std::uint64_t nodes = 0;
    std::uint64_t triangles = 0;
    for (std::size_t i = 0; i < list.rays.size(); i += stride) {
        const RayRecord& r = list.rays[i];
        TraversalSteps steps;
        intersect(scene.bvh, scene.triangles, Ray{r.origin, r.direction, r.t_min, r.t_max}, &steps,
                  list.any_hit);
        nodes += steps.nodes;
        triangles += steps.triangles;
        ++rays;
    }
    result.nodes_per_ray = static_cast<double>(nodes) / static_cast<double>(rays);
    result.triangles_per_ray = static_cast<double>(triangles) / static_cast<double>(rays);
}

// Embree's default mode lets rays slip through edges. Where the two differ, its robust mode is asked.
void compare(const BenchScene& scene, const RayList& list, std::span<const RayHitRecord> found,
             std::span<const RayHitRecord> embree, BenchKind& result) {
    const std::vector<std::size_t> places =
        differences(scene.triangles, list.rays, list.any_hit, found, embree);
    result.mismatches = places.size();
    result.embree_leaks = 0;
    if (places.empty()) return;
    std::vector<RayRecord> rays;
    std::vector<RayHitRecord> ours;
    for (const std::size_t i : places) {
        rays.push_back(list.rays[i]);
        ours.push_back(found[i]);
    }
    std::vector<RayHitRecord> theirs(rays.size());
    scene.robust().trace(rays, list.any_hit, {}, theirs);
    result.mismatches = differences(scene.triangles, rays, list.any_hit, ours, theirs).size();
    result.embree_leaks = places.size() - *result.mismatches;
}

// The packet call that is fastest for these rays.
YardstickCall fastestPacket(Yardstick& yardstick, const RayList& list, std::span<RayHitRecord> hits) {
    YardstickCall best{1, false};
    double least = 0.0;
    for (const YardstickCall& call : yardstick.packetCalls()) {
        const double seconds = yardstick.trace(list.rays, list.any_hit, call, hits);
        if (best.width > 1 && seconds >= least) continue;
        best = call;
        least = seconds;
    }
    return best;
}

}  // namespace

BenchKind measureKind(const BenchScene& scene, const RayList& list, std::uint32_t runs,
                      const std::function<void()>& run_done) {
    BenchKind result;
    result.kind = list.kind;
    result.count = list.rays.size();
    if (list.rays.empty()) return result;
    countSteps(scene, list, result);

    // As the renderer does where it has lists; primary rays are the rasteriser's, and neighbours walk alike.
    const uint rays_per_thread = list.kind == "primary" ? 1 : raysPerThread(scene.device);
    RayTracer tracer(scene.device, scene.on_device, list.rays, list.any_hit, rays_per_thread);
    tracer.trace();  // compiles, and finds how much to submit at once
    const std::vector<RayHitRecord> found = tracer.hits();
    result.truncated_traversals = static_cast<std::uint64_t>(std::count_if(
        found.begin(), found.end(), [](const RayHitRecord& hit) { return hit.triangle == kRayTruncated; }));
    std::vector<RayHitRecord> hits(list.rays.size());
    YardstickCall packet;
    if (scene.yardstick != nullptr) {
        packet = fastestPacket(*scene.yardstick, list, hits);
        scene.yardstick->trace(list.rays, list.any_hit, {}, hits);
        compare(scene, list, found, hits, result);
        if (packet.width > 1)
            result.packet_call = fmt::format("{}{}", packet.width, packet.coherent ? " coherent" : "");
    }
    run_done();

    const bool on_cpu = scene.device.report().type == "cpu";
    std::vector<double> device, single, packets, ratio_single, ratio_packets, ratio_cpu;
    for (std::uint32_t run = 0; run < runs; ++run) {
        const double started = processSeconds();
        device.push_back(mraysPerSecond(list.rays.size(), tracer.trace()));
        const double traced = processSeconds();
        if (scene.yardstick != nullptr) {
            single.push_back(
                mraysPerSecond(list.rays.size(), scene.yardstick->trace(list.rays, list.any_hit, {}, hits)));
            if (on_cpu) ratio_cpu.push_back((processSeconds() - traced) / (traced - started));
            ratio_single.push_back(device.back() / single.back());
            if (packet.width > 1) {
                packets.push_back(mraysPerSecond(
                    list.rays.size(), scene.yardstick->trace(list.rays, list.any_hit, packet, hits)));
                ratio_packets.push_back(device.back() / packets.back());
            }
        }
        run_done();
    }
    result.mrays = summarise(device);
    result.embree1_mrays = summarise(single);
    result.embree_packet_mrays = summarise(packets);
    result.embree1_ratio = summarise(ratio_single);
    result.embree1_cpu_ratio = summarise(ratio_cpu);
    result.embree_packet_ratio = summarise(ratio_packets);
    return result;
}

}  // namespace licht
