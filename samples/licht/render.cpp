#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>
#include <span>

#include "licht/core/file.h"
#include "licht/gpu/lanes.h"
#include "licht/image/files.h"
#include "licht/render/renderer.h"
#include "licht/run/process_clock.h"
#include "licht/run/queue_choice.h"
#include "licht/run/render_loop.h"
#include "licht/shared/queue_records.h"
#include "samples/licht/commands.h"
#include "samples/licht/exr_layers.h"
#include "samples/licht/interrupt.h"
#include "samples/licht/report.h"
#include "samples/licht/scene_source.h"
#include "samples/licht/series_report.h"
#include "samples/licht/text.h"

namespace licht {
namespace {

/// Fails before anything is rendered when a file could not be written afterwards.
void checkWritable(const std::filesystem::path& path) {
    const AtomicFile probe(path);
}

bool isExr(const std::filesystem::path& path) {
    return lowerCase(path.extension().string()) == ".exr";
}

StopRules stopRules(const RenderOptions& options) {
    StopRules rules;
    rules.samples = std::numeric_limits<std::uint32_t>::max() - options.settings.first_sample;
    if (options.samples)
        rules.samples = *options.samples;
    else if (!options.seconds && !options.error)
        rules.samples = kDefaultSamples;
    rules.seconds = options.seconds;
    rules.error = options.error;
    return rules;
}

/// Display values without alpha.
Image opaquePicture(const Image& rgba) {
    Image rgb(rgba.width, rgba.height, 3);
    for (int y = 0; y < rgb.height; ++y)
        for (int x = 0; x < rgb.width; ++x)
            for (int c = 0; c < rgb.channels; ++c) rgb.at(x, y, c) = rgba.at(x, y, c);
    return rgb;
}

glm::dvec3 pictureMean(const Film& film) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i + 3 < film.mean.texels.size(); i += 4)
        sum += glm::dvec3(film.mean.texels[i], film.mean.texels[i + 1], film.mean.texels[i + 2]);
    return sum / (static_cast<double>(film.size.x) * film.size.y);
}

void describeRun(RenderReport& report, const gpu::Device& device, const Renderer& renderer,
                 const LoopResult& result) {
    report.device = device.report().name;
    report.driver = device.report().driver;
    report.samples = result.film.samples;
    report.stopped_by = result.stopped_by;
    report.first_image_seconds = result.first_image_seconds;
    report.render_seconds = result.render_seconds;
    report.error = result.error;
    report.effects = renderer.effects().names();
    report.device_peak_bytes = device.devicePeakBytes();
    report.mean = pictureMean(result.film);
    report.light = renderer.lightBatches();
    if (!result.film.counts.texels.empty()) {
        const auto [fewest, most] =
            std::minmax_element(result.film.counts.texels.begin(), result.film.counts.texels.end());
        report.fewest_samples = static_cast<std::uint32_t>(*fewest);
        report.most_samples = static_cast<std::uint32_t>(*most);
    }
}

/// What must be known before the picture is begun: how deep to follow the light, and what a shortcut takes.
void runPilots(const RenderOptions& options, gpu::Device& device, const Scene& scene, const Camera& camera,
               RenderReport& report) {
    if (options.auto_bounces) {
        const std::uint32_t most =
            options.queues == QueueUse::on ? std::min(kMostQueueBounces, kMostAutoBounces) : kMostAutoBounces;
        report.depth = chooseDepth(device, scene, camera, report.settings,
                                   options.error.value_or(kDefaultTailShare), most);
        report.settings.bounces = report.depth->bounces;
        if (!report.depth->reached && !options.quiet)
            fmt::print(stderr,
                       "licht: warning: --bounces auto: no depth up to {} leaves less than {} of the light; "
                       "{} are followed\n",
                       most, report.depth->wanted_share, report.depth->bounces);
    }
    if (options.settings.regularise)
        report.regularisation = measureRegularisation(device, scene, camera, report.settings);
}

/// What makes a picture doubtful is said, not only reported.
void warnOfDoubts(const RenderReport& report) {
    const RenderStatistics& statistics = report.statistics;
    if (const std::string bias = biasLine(report); !bias.empty())
        fmt::print(stderr, "licht: warning: the picture is biased: {}\n", bias);
    if (statistics.nonfinite_samples > 0)
        fmt::print(stderr, "licht: warning: {} samples were no finite number and count as black\n",
                   statistics.nonfinite_samples);
    if (statistics.cut_walks > 0)
        fmt::print(
            stderr,
            "licht: warning: in {} samples the driver ended the search for a hit early; surfaces may be "
            "missing\n",
            statistics.cut_walks);
}

}  // namespace

int render(const RenderOptions& options) {
    for (const auto& output : options.outputs) checkWritable(output);
    if (options.report) checkWritable(*options.report);

    const auto load_start = std::chrono::steady_clock::now();
    const NamedScene source = loadScene(options.source);
    const Shot shot = chooseShot(source, options.source.camera, options.size);
    RenderReport report;
    report.load_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - load_start).count();
    report.scene = options.source.scene;
    report.camera = shot.camera_name;
    report.size = shot.size;
    report.settings = options.settings;
    report.settings.size = shot.size;
    report.settings.aovs = options.layers.aovs;
    report.notes = source.scene.notes;
    report.outputs = options.outputs;
    if (report.outputs.empty()) {
        report.outputs.emplace_back(source.name + ".png");
        checkWritable(report.outputs.front());
    }

    gpu::DeviceOptions device_options;
    device_options.device = options.device;
    gpu::Device device(device_options);
    runPilots(options, device, source.scene, shot.camera, report);
    report.settings.queues =
        chooseQueues(options.queues, report.settings, stopRules(options), raysPerThread(device) > 1);
    Renderer renderer(device, source.scene, shot.camera, report.settings);
    if (!options.quiet) printWarnings(source.scene);

    InterruptWatch interrupt;
    std::optional<ProgressLine> progress(std::in_place, stderr, options.quiet);
    const StopRules rules = stopRules(options);
    const LoopHooks hooks{[&interrupt] { return interrupt.asked(); },
                          [&progress](const ProgressState& state) { progress->show(state); }};
    const LoopResult result = options.settings.adaptive
                                  ? renderAdaptively(renderer, rules, hooks)
                                  : renderUntil(renderer, report.settings, rules, hooks);
    progress.reset();
    interrupt.shield();

    describeRun(report, device, renderer, result);
    const double exposure = options.exposure.value_or(source.scene.default_exposure);
    for (const auto& output : report.outputs) {
        if (isExr(output))
            writeExr(output, exrPicture(result.film, options.layers, reportAttributes(report)));
        else
            writePng(output,
                     opaquePicture(renderer.readDisplay(options.tonemap, static_cast<float>(exposure))));
        if (!options.quiet) fmt::print("wrote {} ({}x{})\n", output.string(), shot.size.x, shot.size.y);
    }
    report.statistics = renderer.statistics();
    if (!options.quiet) warnOfDoubts(report);
    report.host_peak_bytes = hostPeakBytes();
    report.total_seconds = secondsSinceProcessStart();
    if (options.report) {
        const std::string json = reportJson(report);
        writeFile(*options.report, std::as_bytes(std::span(json)));
    }
    if (!options.quiet) fmt::print("{}\n", reportLine(report));
    if (result.stopped_by == Stop::interrupt)
        fmt::print(stderr, "licht: interrupted: wrote what was there, {}\n", reportLine(report));
    return device.validationMessages().empty() ? 0 : 1;
}

}  // namespace licht
