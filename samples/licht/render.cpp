#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <span>

#include "licht/core/clock.h"
#include "licht/core/file.h"
#include "licht/image/files.h"
#include "licht/render/renderer.h"
#include "licht/run/plan.h"
#include "licht/run/process_clock.h"
#include "licht/run/render_loop.h"
#include "samples/licht/commands.h"
#include "samples/licht/exr_layers.h"
#include "samples/licht/interrupt.h"
#include "samples/licht/outputs.h"
#include "samples/licht/report.h"
#include "samples/licht/scene_source.h"
#include "samples/licht/series_report.h"
#include "samples/licht/text.h"

namespace licht {
namespace {

bool isExr(const std::filesystem::path& path) {
    return lowerCase(path.extension().string()) == ".exr";
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
    report.filter_bias = result.film.filter_bias;
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

/// The pilot found no depth that spends the light, or the device cannot be trusted with queues.
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

/// What makes a picture doubtful is said, not only reported.
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

/// A picture that shows nothing says why. Below 1.5e-4 the nearest of 256 sRGB codes is 0.
void warnOfBlackness(const Film& film, double exposure) {
    constexpr double kLeastShown = 1.5e-4;
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

/// A picture that is there is not lost because another file cannot be written: says why and which files are
/// whole, and goes on.
class FilesWritten {
public:
    template <typename Write>
    bool add(const std::filesystem::path& path, const Write& write) {
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
    [[nodiscard]] bool all() const { return all_; }

private:
    std::string whole_;
    bool all_ = true;
};

/// All files that a run gives, checked against all that it takes.
void requireFilesOfItsOwn(const RenderOptions& options, const Scene& scene, const RenderReport& report) {
    std::vector<std::filesystem::path> outputs = report.outputs;
    if (options.report) outputs.emplace_back(*options.report);
    std::vector<std::filesystem::path> inputs = scene.files;
    if (options.source.environment) inputs.emplace_back(*options.source.environment);
    requireOwnFiles(outputs, inputs);
}

/// What is known before anything is drawn: what was asked for, and where the pictures go.
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

/// Long compilations show which program they are at.
gpu::DeviceOptions deviceOptions(const RenderOptions& options, std::optional<ProgressLine>& progress) {
    gpu::DeviceOptions device_options;
    device_options.device = options.device;
    device_options.on_compiling = [&progress](std::string_view program) {
        if (progress) progress->announce(fmt::format("compiling '{}'", program));
    };
    return device_options;
}

}  // namespace

int render(const RenderOptions& options) {
    for (const auto& output : options.outputs) checkWritable(output);
    if (options.report) checkWritable(*options.report);

    const Clock::time_point load_start = Clock::now();
    const NamedScene source = loadScene(options.source);
    const Shot shot = chooseShot(source, options.source.camera, options.size);
    RenderReport report = beginReport(options, source, shot);
    report.load_seconds = secondsSince(load_start);
    requireFilesOfItsOwn(options, source.scene, report);

    std::optional<ProgressLine> progress(std::in_place, stderr, options.quiet);
    gpu::Device device(deviceOptions(options, progress));
    RunSettings run = options.run;
    run.render.size = shot.size;
    const RunPlan plan = planRun(device, source.scene, shot.camera, run);
    report.settings = plan.settings;
    report.depth = plan.depth;
    report.regularisation = plan.regularisation;
    Renderer renderer(device, source.scene, shot.camera, plan.settings);
    progress->clear();
    if (!options.quiet) {
        warnOfPlan(plan, device.report());
        printWarnings(source.scene);
    }

    InterruptWatch interrupt;
    const LoopHooks hooks{[&interrupt] { return interrupt.asked(); },
                          [&progress](const ProgressState& state) { progress->show(state); }};
    const LoopResult result = renderUntil(renderer, plan.settings, plan.rules, hooks);
    progress.reset();
    interrupt.shield();

    describeRun(report, device, renderer, result);
    const double exposure = options.run.exposure.value_or(source.scene.default_exposure);
    FilesWritten files;
    for (const auto& output : report.outputs) {
        const bool good = files.add(output, [&] {
            if (isExr(output))
                writeExr(output,
                         exrPicture(result.film, options.run.render.layers, reportAttributes(report)));
            else
                writePng(output, opaquePicture(renderer.readDisplay(options.run.tonemap,
                                                                    static_cast<float>(exposure))));
        });
        if (good && !options.quiet)
            printOut(fmt::format("wrote {} ({}x{})\n", oneLine(output.string()), shot.size.x, shot.size.y));
    }
    report.statistics = renderer.statistics();
    if (!options.quiet) {
        warnOfDoubts(report);
        warnOfBlackness(result.film, exposure);
    }
    report.host_peak_bytes = hostPeakBytes();
    report.total_seconds = secondsSinceProcessStart();
    if (options.report) {
        const std::string json = reportJson(report);
        files.add(*options.report, [&] { writeFile(*options.report, std::as_bytes(std::span(json))); });
    }
    if (!options.quiet) printOut(reportLine(report) + "\n");
    if (result.stopped_by == Stop::interrupt)
        printError(fmt::format("licht: interrupted: wrote what was there, {}\n", reportLine(report)));
    const int code = files.all() && device.validationMessages().empty() ? 0 : 1;
    // What runs at a usual exit may wait for a hung device without end.
    if (device.givenUp()) {
        std::fflush(nullptr);
        std::_Exit(code);
    }
    return code;
}

}  // namespace licht
