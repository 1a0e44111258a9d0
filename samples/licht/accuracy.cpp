#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "licht/core/clock.h"
#include "licht/core/file.h"
#include "licht/core/json_text.h"
#include "licht/core/progress.h"
#include "licht/run/temporal_accuracy.h"
#include "licht/settings/choices.h"
#include "samples/licht/camera_path.h"
#include "samples/licht/commands.h"
#include "samples/licht/interrupt.h"
#include "samples/licht/outputs.h"
#include "samples/licht/plot.h"
#include "samples/licht/render_steps.h"
#include "samples/licht/scene_in_time.h"
#include "samples/licht/text.h"

namespace licht {
namespace {

using Json = nlohmann::ordered_json;

/// "recover_frames", of each kind of change, and "recovery", what that was read from.
void addRecoveries(Json& json, const Recoveries& recoveries) {
    Json frames = Json::object();
    Json curves = Json::object();
    for (std::size_t kind = 0; kind < recoveries.size(); ++kind) {
        const std::optional<std::uint32_t> recovered = recoveries[kind].frames();
        frames[kChangeNames[kind]] = recovered ? Json(*recovered) : Json(nullptr);
        Json& curve = curves[kChangeNames[kind]] = Json::array();
        for (const RecoveryStep& step : recoveries[kind].steps) {
            const double pixels = std::max(1.0, static_cast<double>(step.pixels));
            curve.push_back({{"relmse", step.error / pixels},
                             {"fresh_relmse", step.fresh_error / pixels},
                             {"pixels", step.pixels}});
        }
    }
    json["recover_frames"] = frames;
    json["recovery"] = curves;
}

Json accuracyJson(const AccuracyOptions& options, const Shot& shot, const TemporalAccuracy& accuracy) {
    Json json{{"scene", options.source.scene},
              {"camera", shot.camera_name},
              {"width", shot.size.x},
              {"height", shot.size.y},
              {"path", options.path.path},
              {"fps", options.path.rate},
              {"spp", options.run.samples.value_or(kDefaultFrameSamples)},
              {"reference_spp", options.reference_samples},
              {"reference_relmse", accuracy.reference_rel_mse},
              {"frames", options.path.frames},
              {"measured_frames", accuracy.frames},
              {"modes", Json::array()}};
    for (const TemporalMode& mode : accuracy.modes) {
        Json frames = Json::array();
        for (std::size_t i = 0; i < mode.frames.size(); ++i)
            frames.push_back({{"frame", i},
                              {"relmse", mode.frames[i].rel_mse},
                              {"flip", mode.frames[i].flip},
                              {"ms", 1000.0 * mode.frames[i].seconds}});
        json["modes"].push_back(
            {{"mode", nameOf(mode.mode)},
             {"relmse", mode.relMse()},
             {"flip", mode.flip()},
             {"ms_per_frame", 1000.0 * mode.seconds()},
             {"flicker", mode.flicker},
             {"ghost",
              {{"value", mode.ghost.value},
               {"standard_error",
                mode.ghost.standard_error >= 0.0 ? Json(mode.ghost.standard_error) : Json(nullptr)},
               {"pixels", mode.ghost.pixels}}},
             {"frames", frames}});
        addRecoveries(json["modes"].back(), mode.recoveries);
    }
    return json;
}

std::string accuracyCsv(const TemporalAccuracy& accuracy) {
    std::string text = "mode,frame,relmse,flip,ms\n";
    for (const TemporalMode& mode : accuracy.modes)
        for (std::size_t i = 0; i < mode.frames.size(); ++i)
            text += fmt::format("{},{},{:.6g},{:.6g},{:.3f}\n", nameOf(mode.mode), i, mode.frames[i].rel_mse,
                                mode.frames[i].flip, 1000.0 * mode.frames[i].seconds);
    return text;
}

std::string accuracySvg(const AccuracyOptions& options, const TemporalAccuracy& accuracy) {
    Plot plot{
        oneLine(fmt::format("{}, path {}: error of each frame", options.source.scene, options.path.path)),
        "frame",
        "relMSE",
        {}};
    for (const TemporalMode& mode : accuracy.modes) {
        Curve curve{std::string(nameOf(mode.mode)), {}};
        for (std::size_t i = 0; i < mode.frames.size(); ++i)
            curve.points.emplace_back(static_cast<double>(i), mode.frames[i].rel_mse);
        plot.curves.push_back(std::move(curve));
    }
    return svgText(plot);
}

/// By kind of change, "-" where it was not over in the frames watched, or touched no pixel.
std::string recoveryText(const Recoveries& recoveries) {
    std::string text;
    for (const Recovery& recovery : recoveries) {
        const std::optional<std::uint32_t> frames = recovery.frames();
        text += fmt::format("{}{}", text.empty() ? "" : " ", frames ? std::to_string(*frames) : "-");
    }
    return text;
}

std::string accuracyText(const TemporalAccuracy& accuracy) {
    if (accuracy.frames == 0) return "no frame was measured\n";
    std::string text = fmt::format("{:<16}{:>10}{:>10}{:>10}{:>9}{:>10}{:>20}{:>12}\n", "mode", "ms/frame",
                                   "relMSE", "of raw", "FLIP", "flicker", "ghost", "recovers");
    const TemporalMode& raw = accuracy.modes.front();
    for (const TemporalMode& mode : accuracy.modes) {
        const std::string ghost =
            mode.ghost.standard_error < 0.0
                ? "-"
                : fmt::format("{:.2g} +- {:.1g}", mode.ghost.value, mode.ghost.standard_error);
        // An error that is all the truth's own may be negative without it.
        const std::string share = raw.relMse() > 0.0 && mode.relMse() > 0.0
                                      ? fmt::format("1/{:.3g}", raw.relMse() / mode.relMse())
                                      : "-";
        text += fmt::format("{:<16}{:>10.1f}{:>10.3g}{:>10}{:>9.5f}{:>10.3g}{:>20}{:>12}\n",
                            nameOf(mode.mode), 1000.0 * mode.seconds(), mode.relMse(), share, mode.flip(),
                            mode.flicker, ghost, recoveryText(mode.recoveries));
    }
    return text + fmt::format("relMSE of the references, taken off: {:.2g}\n", accuracy.reference_rel_mse);
}

}  // namespace

int accuracy(const AccuracyOptions& options) {
    std::vector<std::filesystem::path> outputs;
    for (const auto& file : {options.json, options.csv, options.svg}) {
        if (!file) continue;
        checkWritable(*file);
        outputs.push_back(*file);
    }
    const NamedScene source = loadScene(options.source);
    requireOwnFiles(outputs, filesRead(options.source, source.scene, options.path));
    const Shot shot = chooseShot(source, options.source.camera, options.size);
    std::vector<PathFrame> path = followPath(options.path, source, shot);
    addScenes(path, source, options.source, options.path.rate);

    std::optional<ProgressLine> progress(std::in_place, stderr, options.quiet);
    gpu::Device device(deviceOptions(options.device, progress));
    RunSettings run = options.run;
    run.render.size = shot.size;
    run.samples = run.samples.value_or(kDefaultFrameSamples);
    const RunPlan plan = planRun(device, source.scene, path.front().camera, run, options.path.frames);
    progress->clear();
    if (!options.quiet) {
        warnOfPlan(plan, device.report());
        printWarnings(source.scene);
    }

    InterruptWatch interrupt;
    const TemporalHooks hooks{
        [&interrupt] { return interrupt.asked(); },
        [&progress, start = Clock::now()](std::size_t done, std::size_t frames) {
            const double seconds = secondsSince(start);
            progress->show(
                fmt::format("frame {}/{}  {:.1f} s  {:.1f} s left", done, frames, seconds,
                            seconds * static_cast<double>(frames - done) / static_cast<double>(done)));
        }};
    const TemporalAccuracy accuracy = measureTemporal(device, source.scene, path, plan.settings,
                                                      {*run.samples, options.reference_samples}, hooks);
    progress.reset();
    interrupt.shield();
    printOut(accuracyText(accuracy));
    FilesWritten files;
    const auto write = [&files](const std::optional<std::filesystem::path>& file, const std::string& text) {
        if (file) files.add(*file, [&] { writeFile(*file, std::as_bytes(std::span(text))); });
    };
    write(options.json, jsonText(accuracyJson(options, shot, accuracy)));
    write(options.csv, accuracyCsv(accuracy));
    write(options.svg, accuracySvg(options, accuracy));
    if (accuracy.frames < path.size())
        printError(
            fmt::format("licht: interrupted: measured {} of {} frames\n", accuracy.frames, path.size()));
    return endRun(files, device);
}

}  // namespace licht
