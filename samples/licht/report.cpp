#include "samples/licht/report.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include "licht/render/statistics.h"
#include "licht/settings/choices.h"
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

ordered_json samplingJson(const RenderSettings& settings) {
    ordered_json sampling{{"direct", nameOf(settings.direct)},
                          {"mis", nameOf(settings.mis)},
                          {"lights", nameOf(settings.lights)},
                          {"environment_sampling", nameOf(settings.environment_sampling)},
                          {"sampler", nameOf(settings.sampler)}};
    if (settings.sampler == Sequence::blue) sampling["blue_samples"] = std::uint64_t{1} << settings.blue_bits;
    return sampling;
}

ordered_json adaptiveJson(const RenderReport& report) {
    if (!report.settings.adaptive) return nullptr;
    return {{"fewest_samples", report.fewest_samples}, {"most_samples", report.most_samples}};
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
    json["device"] = report.device;
    json["driver"] = report.driver;
    json["size"] = {report.size.x, report.size.y};
    json["spp"] = report.samples;
    json["first_sample"] = report.settings.first_sample;
    json["seed"] = report.settings.seed;
    json["bounces"] = report.settings.bounces;
    json["bounces_auto"] = depthJson(report);
    json["sampling"] = samplingJson(report.settings);
    json["adaptive"] = adaptiveJson(report);
    json["declared_bias"] = biasJson(report);
    json["queues"] = report.settings.queues;
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
    json["orders"] = ordersJson(report);
    json["tail"] = tailJson(report);
    json["nonfinite_samples"] = statistics.nonfinite_samples;
    json["cut_walks"] = statistics.cut_walks;
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
    // File names and scene texts may be any bytes; what is not UTF-8 is replaced, so that the report is
    // always valid JSON.
    return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::vector<std::pair<std::string, std::string>> reportAttributes(const RenderReport& report) {
    const std::string bias = biasLine(report);
    return {{"licht.version", LICHT_VERSION},
            {"licht.scene", report.scene},
            {"licht.camera", report.camera},
            {"licht.spp", fmt::format("{}", report.samples)},
            {"licht.firstSample", fmt::format("{}", report.settings.first_sample)},
            {"licht.seed", fmt::format("{}", report.settings.seed)},
            {"licht.bounces", fmt::format("{}", report.settings.bounces)},
            {"licht.direct", std::string(nameOf(report.settings.direct))},
            {"licht.mis", std::string(nameOf(report.settings.mis))},
            {"licht.lights", std::string(nameOf(report.settings.lights))},
            {"licht.environmentSampling", std::string(nameOf(report.settings.environment_sampling))},
            {"licht.sampler", std::string(nameOf(report.settings.sampler))},
            {"licht.adaptive", report.settings.adaptive ? "yes" : "no"},
            {"licht.declaredBias", bias.empty() ? "none" : bias},
            {"licht.device", report.device},
            {"licht.driver", report.driver},
            {"licht.relativeError", report.error >= 0.0 ? fmt::format("{:.6g}", report.error) : "unknown"},
            {"licht.seconds", fmt::format("{:.3f}", report.render_seconds)}};
}

std::string reportLine(const RenderReport& report) {
    std::string line = fmt::format("{} {} in {:.2f} s", report.samples,
                                   report.samples == 1 ? "sample" : "samples", report.render_seconds);
    if (report.error >= 0.0) line += fmt::format(", relative error {:.3g}", report.error);
    return line;
}

}  // namespace licht
