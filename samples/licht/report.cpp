#include "samples/licht/report.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <nlohmann/json.hpp>
#include <type_traits>
#include <variant>

#include "licht/core/json_text.h"
#include "licht/render/statistics.h"
#include "licht/settings/settings_table.h"
#include "samples/licht/series_report.h"

namespace licht {
namespace {

using nlohmann::ordered_json;

ordered_json notesJson(const std::vector<SceneNote>& notes) {
    ordered_json list = ordered_json::array();
    for (const SceneNote& note : notes)
        list.push_back(
            {{"kind", note.kind == SceneNote::Kind::warning ? "warning" : "skipped"}, {"text", note.text}});
    return list;
}

ordered_json passesJson(const RenderStatistics& statistics) {
    ordered_json passes = ordered_json::object();
    for (const auto& [name, time] : statistics.passes) passes[name] = time.seconds;
    return passes;
}

ordered_json valueJson(const SettingValue& value) {
    return std::visit(
        [](const auto& known) -> ordered_json {
            if constexpr (std::is_same_v<std::decay_t<decltype(known)>, std::monostate>)
                return nullptr;
            else
                return known;
        },
        value);
}

/// All settings as they were asked for, under their options' names.
ordered_json askedJson(const RunSettings& asked) {
    ordered_json json;
    for (const Setting& setting : settingsTable())
        json[reportKeyOf(setting)] = valueJson(setting.value(asked));
    return json;
}

/// What a setting was in the end: a depth may have been chosen.
RunSettings inTheEnd(const RenderReport& report) {
    RunSettings run = report.asked;
    run.render = report.settings;
    run.auto_bounces = false;
    return run;
}

ordered_json samplingJson(const RenderReport& report) {
    ordered_json sampling;
    for (const Setting& setting : settingsTable())
        if (setting.group == SettingGroup::sampling && !setting.names.empty())
            sampling[reportKeyOf(setting)] = valueJson(setting.value(inTheEnd(report)));
    if (report.settings.sampler == Sequence::blue)
        sampling["blue_samples"] = std::uint64_t{1} << report.settings.blue_bits;
    return sampling;
}

ordered_json environmentJson(const RenderReport& report) {
    if (report.environment.empty()) return nullptr;
    return {{"name", report.environment},
            {"rotation_degrees", report.environment_rotation},
            {"strength", report.environment_strength}};
}

ordered_json adaptiveJson(const RenderReport& report) {
    if (!report.settings.adaptive) return nullptr;
    return {{"fewest_samples", report.fewest_samples}, {"most_samples", report.most_samples}};
}

ordered_json sequenceJson(const RenderReport& report) {
    if (!report.sequence) return nullptr;
    ordered_json frames = ordered_json::array();
    for (const FrameReport& frame : report.sequence->frames)
        frames.push_back(
            {{"frame", frame.frame},
             {"seconds", frame.seconds},
             {"relative_error", frame.error >= 0.0 ? ordered_json(frame.error) : ordered_json(nullptr)},
             {"cut", frame.cut}});
    return {{"path", report.sequence->path}, {"fps", report.sequence->rate}, {"frames", frames}};
}

}  // namespace

std::uint64_t hostPeakBytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    constexpr std::uint64_t kBytesPerUnit = 1024;  // Linux counts ru_maxrss in KiB
    return static_cast<std::uint64_t>(usage.ru_maxrss) * kBytesPerUnit;
}

std::string reportJson(const RenderReport& report) {
    const RenderStatistics& statistics = report.statistics;
    ordered_json json;
    json["scene"] = report.scene;
    json["camera"] = report.camera;
    json["environment"] = environmentJson(report);
    json["device"] = report.device;
    json["driver"] = report.driver;
    json["size"] = {report.size.x, report.size.y};
    json["spp"] = report.samples;
    json["first_sample"] = report.settings.first_sample;
    json["seed"] = report.settings.seed;
    json["bounces"] = report.settings.bounces;
    json["bounces_auto"] = depthJson(report);
    json["sampling"] = samplingJson(report);
    json["adaptive"] = adaptiveJson(report);
    json["declared_bias"] = biasJson(report);
    json["queues"] = report.settings.queues;
    json["settings"] = askedJson(report.asked);
    json["stopped_by"] = stopName(report.stopped_by);
    json["interrupted"] = report.stopped_by == Stop::interrupt;
    json["seconds"] = {{"load", report.load_seconds},
                       {"bvh", statistics.bvh_seconds},
                       {"upload", statistics.upload_seconds},
                       {"pipelines", statistics.pipeline_seconds},
                       {"first_image", report.first_image_seconds},
                       {"render", report.render_seconds},
                       {"total", report.total_seconds}};
    json["passes"] = passesJson(statistics);
    json["rays"] = {{"primary", statistics.primary_rays},
                    {"bounce", statistics.bounce_rays},
                    {"shadow", statistics.shadow_rays}};
    json["rays_per_second"] =
        report.render_seconds > 0.0 ? static_cast<double>(report.rays()) / report.render_seconds : 0.0;
    json["relative_error"] = report.error >= 0.0 ? ordered_json(report.error) : ordered_json(nullptr);
    json["unfiltered_relative_error"] =
        report.unfiltered_error >= 0.0 ? ordered_json(report.unfiltered_error) : ordered_json(nullptr);
    json["sequence"] = sequenceJson(report);
    json["orders"] = ordersJson(report);
    json["tail"] = tailJson(report);
    json["nonfinite_samples"] = statistics.nonfinite_samples;
    json["truncated_traversals"] = statistics.truncated_traversals;
    if (statistics.environment_samples > 0)
        json["environment_tries_per_sample"] = static_cast<double>(statistics.environment_tries) /
                                               static_cast<double>(statistics.environment_samples);
    json["effects"] = report.effects;
    json["memory"] = {{"host_peak_bytes", report.host_peak_bytes},
                      {"device_bytes", report.device_peak_bytes},
                      {"geometry_bytes", statistics.geometry_bytes}};
    json["notes"] = notesJson(report.notes);
    json["outputs"] = ordered_json::array();
    for (const auto& output : report.outputs) json["outputs"].push_back(output.string());
    return jsonText(json);
}

std::vector<std::pair<std::string, std::string>> reportAttributes(const RenderReport& report) {
    const std::string bias = biasLine(report);
    std::vector<std::pair<std::string, std::string>> attributes{
        {"licht.version", LICHT_VERSION},
        {"licht.scene", report.scene},
        {"licht.camera", report.camera},
        {"licht.environment", report.environment.empty() ? "none" : report.environment},
        {"licht.environmentRotation", fmt::format("{}", report.environment_rotation)},
        {"licht.environmentStrength", fmt::format("{}", report.environment_strength)},
        {"licht.spp", fmt::format("{}", report.samples)},
        {"licht.declaredBias", bias.empty() ? "none" : bias},
        {"licht.device", report.device},
        {"licht.driver", report.driver},
        {"licht.relativeError", report.error >= 0.0 ? fmt::format("{:.6g}", report.error) : "unknown"},
        {"licht.seconds", fmt::format("{:.3f}", report.render_seconds)}};
    const RunSettings run = inTheEnd(report);
    for (const Setting& setting : settingsTable())
        if ((setting.uses & kInFile) != 0)
            attributes.emplace_back(attributeNameOf(setting), textOf(setting.value(run)));
    return attributes;
}

std::string reportLine(const RenderReport& report) {
    std::string line = fmt::format("{} {} in {:.2f} s", report.samples,
                                   report.samples == 1 ? "sample" : "samples", report.render_seconds);
    if (report.error >= 0.0) line += fmt::format(", relative error {:.3g}", report.error);
    return line;
}

}  // namespace licht
