#include "samples/licht/series_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "licht/film/film.h"
#include "licht/render/pass_list.h"
#include "licht/render/statistics.h"

namespace licht {
namespace {

using nlohmann::ordered_json;

ordered_json colourJson(const glm::dvec3& rgb) {
    return {rgb.r, rgb.g, rgb.b};
}

ordered_json errorJson(const Estimated& estimated) {
    return estimated.standard_error >= 0.0 ? ordered_json(estimated.standard_error) : ordered_json(nullptr);
}

ordered_json tailJson(const TailEstimate& tail) {
    return {{"share", tail.share.value},
            {"standard_error", errorJson(tail.share)},
            {"lowest", tail.lowest},
            {"highest", tail.highest},
            {"ratio", tail.ratio}};
}

/// The kernels of the queues are timed by bounce. Light of order i is what the vertex before it looked for.
double secondsByPasses(const RenderReport& report, std::uint32_t order) {
    const PassTimes& passes = report.statistics.passes;
    double seconds = order == report.settings.bounces ? passSeconds(passes, PassId::path_shade, order) : 0.0;
    if (order == 0)
        return seconds + passSeconds(passes, PassId::gbuffer) + passSeconds(passes, PassId::path_start);
    for (const PassId kernel : {PassId::path_shade, PassId::path_shadow, PassId::path_trace})
        seconds += passSeconds(passes, kernel, order - 1);
    return seconds;
}

/// One kernel follows the whole path; its time is shared out by the rays.
double secondsByRays(const RenderReport& report, std::uint32_t order) {
    const RenderStatistics& statistics = report.statistics;
    if (order == 0) return passSeconds(statistics.passes, PassId::gbuffer);
    double rays = 0.0;
    for (const std::uint64_t of_order : statistics.order_rays) rays += static_cast<double>(of_order);
    if (!(rays > 0.0)) return 0.0;
    return passSeconds(statistics.passes, PassId::path) * static_cast<double>(statistics.order_rays[order]) /
           rays;
}

/// The share of the light that the clamp took.
Estimated clampShare(const RenderReport& report) {
    return lostShare(report.light, report.mean);
}

glm::dvec3 lostLight(const RenderReport& report) {
    glm::dvec3 lost(0.0);
    double samples = 0.0;
    for (const LightBatch& batch : report.light) {
        lost += batch.lost * static_cast<double>(batch.samples);
        samples += batch.samples;
    }
    return samples > 0.0 ? lost / samples : lost;
}

}  // namespace

ordered_json ordersJson(const RenderReport& report) {
    if (!report.settings.orders) return nullptr;
    const std::vector<OrderEstimate> orders = estimateOrders(report.light);
    ordered_json list = ordered_json::array();
    for (std::uint32_t i = 0; i < orders.size(); ++i) {
        const bool by_passes = report.settings.queues;
        list.push_back({{"order", i},
                        {"share", orders[i].share.value},
                        {"standard_error", errorJson(orders[i].share)},
                        {"mean", colourJson(orders[i].mean)},
                        {"rays", i == 0 ? report.statistics.primary_rays : report.statistics.order_rays[i]},
                        {"seconds", by_passes ? secondsByPasses(report, i) : secondsByRays(report, i)},
                        {"seconds_by", by_passes ? "passes" : "rays"}});
    }
    return list;
}

ordered_json tailJson(const RenderReport& report) {
    if (!report.settings.orders) return nullptr;
    const std::optional<TailEstimate> tail = estimateTail(report.light, report.settings.bounces);
    return tail ? tailJson(*tail) : ordered_json(nullptr);
}

ordered_json depthJson(const RenderReport& report) {
    if (!report.depth) return nullptr;
    const DepthChoice& depth = *report.depth;
    return {{"bounces", depth.bounces},
            {"wanted_share", depth.wanted_share},
            {"reached", depth.reached},
            {"tail", depth.tail ? tailJson(*depth.tail) : ordered_json(nullptr)},
            {"pilot_bounces", depth.pilot_bounces},
            {"pilot_seconds", depth.seconds}};
}

ordered_json biasJson(const RenderReport& report) {
    ordered_json bias;
    if (report.settings.clamp > 0.0F) {
        const Estimated share = clampShare(report);
        bias["clamp"] = {{"limit", report.settings.clamp},
                         {"share", share.value},
                         {"standard_error", errorJson(share)},
                         {"kept", colourJson(report.mean)},
                         {"lost", colourJson(lostLight(report))}};
    }
    if (report.regularisation) {
        const BiasMeasure& measure = *report.regularisation;
        bias["regularise"] = {{"change", measure.change.value},
                              {"standard_error", errorJson(measure.change)},
                              {"pilot_seconds", measure.seconds}};
    }
    if (report.filter_bias >= 0.0) bias["denoise"] = {{"relative_bias", report.filter_bias}};
    if (report.settings.denoise == Denoise::oidn) bias["denoise"] = {{"relative_bias", nullptr}};
    return bias;
}

std::string biasLine(const RenderReport& report) {
    std::string line;
    if (report.settings.clamp > 0.0F)
        line = fmt::format("clamp {} cd/m^2 took {:.3g} % of the light", report.settings.clamp,
                           100.0 * clampShare(report).value);
    if (report.regularisation)
        line += fmt::format("{}regularise changed the light by {:+.3g} +- {:.2g} %", line.empty() ? "" : ", ",
                            100.0 * report.regularisation->change.value,
                            100.0 * report.regularisation->change.standard_error);
    if (report.filter_bias >= 0.0)
        line += fmt::format("{}denoise moved it by an estimated {:.2g} % beside the noise that it took",
                            line.empty() ? "" : ", ", 100.0 * report.filter_bias);
    if (report.settings.denoise == Denoise::oidn)
        line += fmt::format("{}denoise oidn moved it by an unknown amount", line.empty() ? "" : ", ");
    return line;
}

}  // namespace licht
