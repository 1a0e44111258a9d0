#include "samples/licht/render_steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <span>

#include "licht/core/clock.h"
#include "licht/core/file.h"
#include "licht/film/error_estimate.h"
#include "licht/image/files.h"
#include "licht/run/process_clock.h"
#include "samples/licht/camera_path.h"
#include "samples/licht/exr_layers.h"
#include "samples/licht/outputs.h"
#include "samples/licht/series_report.h"
#include "samples/licht/text.h"

namespace licht {
namespace {

bool isExr(const std::filesystem::path& path) {
    return lowerCase(path.extension().string()) == ".exr";
}

glm::dvec3 pictureMean(const Film& film) {
    glm::dvec3 sum(0.0);
    if (film.mean.texels.empty()) return sum;
    for (std::size_t i = 0; i + 3 < film.mean.texels.size(); i += 4)
        sum += glm::dvec3(film.mean.texels[i], film.mean.texels[i + 1], film.mean.texels[i + 2]);
    return sum / (static_cast<double>(film.size.x) * film.size.y);
}

}  // namespace

void filterOnHost(Oidn& oidn, LoopResult& result) {
    const Clock::time_point start = Clock::now();
    oidn.filter(result.film);
    result.error = relativeError(result.film);
    result.render_seconds += secondsSince(start);
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
    report.filter_bias = result.film.filter_bias;
    report.unfiltered_error = result.film.unfiltered_error;
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

void notePlan(RenderReport& report, const RunPlan& plan) {
    report.settings = plan.settings;
    if (plan.oidn) report.settings.denoise = Denoise::oidn;
    report.depth = plan.depth;
    report.regularisation = plan.regularisation;
}

void warnOfPlan(const RunPlan& plan, const gpu::DeviceReport& device) {
    if (plan.depth && !plan.depth->reached)
        printError(fmt::format(
            "licht: warning: --bounces auto: no depth up to {} leaves less than {} of the light; {} "
            "are followed\n",
            plan.depth->bounces, plan.depth->wanted_share, plan.depth->bounces));
    if (!plan.queue_trouble.empty())
        printError(
            fmt::format("licht: warning: '{}' ({}) gets {} wrong: paths go through one kernel, not queues\n",
                        device.name, device.driver, plan.queue_trouble));
}

void warnOfDoubts(const RenderReport& report) {
    const RenderStatistics& statistics = report.statistics;
    if (const std::string bias = biasLine(report); !bias.empty())
        printError(fmt::format("licht: warning: the picture is biased: {}\n", bias));
    if (statistics.nonfinite_samples > 0)
        printError(fmt::format("licht: warning: {} samples were no finite number and count as black\n",
                               statistics.nonfinite_samples));
    if (statistics.truncated_traversals > 0)
        printError(fmt::format(
            "licht: warning: the driver ended {} searches for a hit early; surfaces may be missing\n",
            statistics.truncated_traversals));
}

void warnOfBlackness(const Film& film, double exposure) {
    constexpr double kLeastShown = 1.5e-4;  // below, the nearest of 256 sRGB codes is 0
    float brightest = 0.0F;
    float covered = 0.0F;
    for (std::size_t i = 0; i + 3 < film.mean.texels.size(); i += 4) {
        for (std::size_t c = 0; c < 3; ++c) brightest = std::max(brightest, film.mean.texels[i + c]);
        covered = std::max(covered, film.mean.texels[i + 3]);
    }
    if (static_cast<double>(brightest) * std::exp2(exposure) >= kLeastShown) return;
    const std::string why =
        covered <= 0.0F ? "the camera sees nothing of the scene"
        : brightest <= 0.0F
            ? "no light reaches what the camera sees"
            : fmt::format("its brightest pixel has {:.3g} cd/m^2; --exposure {:.0f} would show it", brightest,
                          std::ceil(-std::log2(brightest)));
    printError(fmt::format("licht: warning: the picture is black: {}\n", why));
}

std::vector<std::filesystem::path> filesRead(const SceneRequest& request, const Scene& scene,
                                             const std::optional<PathRequest>& path) {
    std::vector<std::filesystem::path> files = scene.files;
    if (request.environment) files.emplace_back(*request.environment);
    if (path && isPathFile(*path)) files.emplace_back(path->path);
    return files;
}

void requireFilesOfItsOwn(const RenderOptions& options, const Scene& scene,
                          std::vector<std::filesystem::path> outputs) {
    if (options.report) outputs.emplace_back(*options.report);
    if (options.unfiltered) outputs.emplace_back(*options.unfiltered);
    requireOwnFiles(outputs, filesRead(options.source, scene, options.path));
}

RenderReport beginReport(const RenderOptions& options, const NamedScene& source, const Shot& shot) {
    RenderReport report;
    report.scene = options.source.scene;
    report.camera = shot.camera_name;
    if (source.scene.environment) report.environment = source.scene.environment->name;
    report.environment_rotation = options.source.environment_rotation.value_or(0.0);
    report.environment_strength = options.source.environment_strength.value_or(1.0);
    report.size = shot.size;
    report.asked = options.run;
    report.notes = source.scene.notes;
    report.outputs = options.outputs;
    if (report.outputs.empty()) {
        report.outputs.emplace_back(source.name + ".png");
        checkWritable(report.outputs.front());
        requireNoStranger(report.outputs.front());
    }
    return report;
}

gpu::DeviceOptions deviceOptions(const std::string& device, std::optional<ProgressLine>& progress) {
    gpu::DeviceOptions device_options;
    device_options.device = device;
    device_options.on_compiling = [&progress](std::string_view program) {
        if (progress) progress->announce(fmt::format("compiling '{}'", program));
    };
    return device_options;
}

bool FilesWritten::add(const std::filesystem::path& path, const std::function<void()>& write) {
    try {
        write();
        whole_ += fmt::format("{}{}", whole_.empty() ? "" : ", ", oneLine(path.string()));
        return true;
    } catch (const std::exception& error) {
        all_ = false;
        printError(fmt::format("licht: {} (written so far: {})\n", oneLine(error.what()),
                               whole_.empty() ? "nothing" : whole_));
        return false;
    }
}

bool writePicture(FilesWritten& files, const std::filesystem::path& output, Renderer& renderer,
                  const Film& film, const RenderReport& report, double exposure) {
    return files.add(output, [&] {
        const Tonemap curve = report.asked.tonemap;
        const auto stops = static_cast<float>(exposure);
        if (isExr(output))
            writeExr(output, exrPicture(film, report.asked.render.layers, reportAttributes(report)));
        else if (report.settings.denoise == Denoise::oidn)
            writePng(output, withoutAlpha(renderer.readDisplay(film.mean, curve, stops)));
        else
            writePng(output, withoutAlpha(renderer.readDisplay(curve, stops)));
    });
}

void writeUnfiltered(FilesWritten& files, const RenderOptions& options, Renderer& renderer, double exposure) {
    if (!options.unfiltered) return;
    const bool good = files.add(*options.unfiltered, [&] {
        writePng(*options.unfiltered, withoutAlpha(renderer.readDisplay(
                                          options.run.tonemap, static_cast<float>(exposure), false)));
    });
    if (good && !options.quiet)
        printOut(fmt::format("wrote {}, before the filter\n", oneLine(options.unfiltered->string())));
}

void writeReport(FilesWritten& files, const RenderOptions& options, RenderReport& report) {
    report.host_peak_bytes = hostPeakBytes();
    report.total_seconds = secondsSinceProcessStart();
    if (!options.report) return;
    const std::string json = reportJson(report);
    files.add(*options.report, [&] { writeFile(*options.report, std::as_bytes(std::span(json))); });
}

int endRun(const FilesWritten& files, const gpu::Device& device) {
    const int code = files.all() && device.validationMessages().empty() ? 0 : 1;
    // What runs at a usual exit may wait for a hung device without end.
    if (device.givenUp()) {
        std::fflush(nullptr);
        std::_Exit(code);
    }
    return code;
}

}  // namespace licht
