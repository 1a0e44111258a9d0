#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <span>

#include "licht/core/clock.h"
#include "licht/core/file.h"
#include "licht/core/progress.h"
#include "licht/on_device/flat_geometry.h"
#include "licht/on_device/gpu_bvh.h"
#include "licht/on_device/gpu_scene.h"
#include "licht/probe/ray_recorder.h"
#include "licht/settings/choices.h"
#include "licht/shared/index.h"
#include "samples/licht/bench_kind.h"
#include "samples/licht/bench_report.h"
#include "samples/licht/commands.h"
#include "samples/licht/outputs.h"
#include "samples/licht/scene_source.h"

namespace licht {
namespace {

/// What is being done, and after the first run how long the runs that are left will take.
class BenchProgress {
public:
    BenchProgress(bool quiet, std::uint32_t runs) : line_(stderr, quiet), runs_(runs) {}

    void show(const std::string& text) { line_.show(text); }
    void startRuns() { start_ = Clock::now(); }
    void runDone(std::string_view kind) {
        ++done_;
        const double left = secondsSince(start_) / done_ * (runs_ - done_);
        show(fmt::format("{}: run {} of {}  {:.0f} s left", kind, done_, runs_, left));
    }

private:
    ProgressLine line_;
    Clock::time_point start_ = Clock::now();
    std::uint32_t runs_;
    std::uint32_t done_ = 0;
};

/// All in world space: one level, as for Embree.
std::vector<BvhTriangle> trianglesOf(const Scene& scene) {
    const std::vector<uint> no_lights(scene.instances.size(), kNoIndex);
    return worldTriangles(flattenGeometry(scene, Effects{}, orderInstances(scene, Effects{}), no_lights));
}

void describeBuild(BenchReport& report, const Bvh& bvh) {
    report.build_seconds = bvh.build_seconds;
    report.mtris_per_second = bvh.build_seconds > 0.0
                                  ? 1e-6 * static_cast<double>(bvh.triangle_ids.size()) / bvh.build_seconds
                                  : 0.0;
    report.depth = bvh.depth;
    report.nodes = bvh.nodes.size();
    report.sah_cost = bvh.sah_cost;
}

std::vector<RayList> raysOf(gpu::Device& device, const Scene& scene, const Shot& shot) {
    const Effects effects = detectEffects(scene);
    const GpuScene on_device(device, scene, effects, {});
    return recordRays(device, on_device, shot.camera, shot.size);
}

}  // namespace

int bench(const BenchOptions& options) {
    if (options.json) checkWritable(*options.json);
    SceneRequest request = options.source;
    if (request.triangles == 0 && takesTriangles(request.scene)) request.triangles = kDefaultBenchTriangles;

    BenchProgress progress(options.quiet, 5 * (options.runs + 1));
    progress.show("scene ...");
    const NamedScene source = loadScene(request);
    if (options.json) requireOwnFiles(std::array{std::filesystem::path(*options.json)}, source.scene.files);
    const Shot shot = chooseShot(source, request.camera, options.size);
    gpu::DeviceOptions device_options;
    device_options.device = options.device;
    gpu::Device device(device_options);

    BenchReport report;
    report.scene = request.scene;
    report.device = device.report().name;
    report.driver = device.report().driver;
    report.size = shot.size;
    report.runs = options.runs;
    report.quality = nameOf(options.quality);

    progress.show("BVH ...");
    const std::vector<BvhTriangle> triangles = trianglesOf(source.scene);
    report.triangles = triangles.size();
    const Bvh bvh = buildBvh(triangles, {options.quality});
    describeBuild(report, bvh);

    progress.show("Embree ...");
    const std::unique_ptr<Yardstick> yardstick = makeYardstick(triangles, false);
    std::unique_ptr<Yardstick> robust;
    if (yardstick) {
        report.embree_version = yardstick->version();
        report.embree_build_seconds = yardstick->buildSeconds();
        report.cores = yardstick->threads();
    }

    progress.show("rays ...");
    const std::vector<RayList> lists = raysOf(device, source.scene, shot);
    const GpuBvh on_device(device, bvh.nodes, triangleTexels(bvh, triangles), bvh.max_stack, false);
    report.bytes_per_triangle = static_cast<double>(on_device.bytes()) /
                                static_cast<double>(std::max<std::size_t>(1, triangles.size()));
    const auto askRobust = [&]() -> Yardstick& {
        if (!robust) robust = makeYardstick(triangles, true);
        return *robust;
    };
    const BenchScene scene{device, on_device, triangles, bvh, yardstick.get(), askRobust};
    progress.startRuns();
    for (const RayList& list : lists)
        report.kinds.push_back(measureKind(scene, list, options.runs, [&] { progress.runDone(list.kind); }));

    if (options.json) {
        const std::string json = benchJson(report);
        writeFile(*options.json, std::as_bytes(std::span(json)));
    }
    progress.show("");
    printOut(benchText(report));
    return device.validationMessages().empty() ? 0 : 1;
}

}  // namespace licht
