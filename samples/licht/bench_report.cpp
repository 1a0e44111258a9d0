#include "samples/licht/bench_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "licht/core/json_text.h"
#include "licht/shared/ray_records.h"

namespace licht {
namespace {

using Json = nlohmann::ordered_json;

template <typename T>
Json orNull(const std::optional<T>& value) {
    return value ? Json(*value) : Json(nullptr);
}

Json medianOf(const std::optional<BenchSamples>& samples) {
    return samples ? Json(samples->median) : Json(nullptr);
}

Json spreadOf(const std::optional<BenchSamples>& samples) {
    return samples ? Json::array({samples->lowest, samples->highest}) : Json(nullptr);
}

Json kindJson(const BenchKind& k) {
    return {{"kind", k.kind},
            {"count", k.count},
            {"mrays_per_second", medianOf(k.mrays)},
            {"embree1_mrays_per_second", medianOf(k.embree1_mrays)},
            {"embree1_ratio", medianOf(k.embree1_ratio)},
            {"embree_packet_ratio", medianOf(k.embree_packet_ratio)},
            {"mismatches", orNull(k.mismatches)},
            {"nodes_per_ray", orNull(k.nodes_per_ray)},
            {"triangles_per_ray", orNull(k.triangles_per_ray)},
            {"mrays_per_second_spread", spreadOf(k.mrays)},
            {"embree1_mrays_per_second_spread", spreadOf(k.embree1_mrays)},
            {"embree1_ratio_spread", spreadOf(k.embree1_ratio)},
            {"embree1_cpu_ratio", medianOf(k.embree1_cpu_ratio)},
            {"embree_packet_mrays_per_second", medianOf(k.embree_packet_mrays)},
            {"embree_packet_call", k.packet_call.empty() ? Json(nullptr) : Json(k.packet_call)},
            {"embree_leaks", orNull(k.embree_leaks)},
            {"truncated_traversals", k.truncated_traversals}};
}

std::string cell(const std::optional<double>& value, int digits) {
    return value ? fmt::format("{:.{}f}", *value, digits) : "-";
}

std::string cell(const std::optional<BenchSamples>& value, int digits) {
    return cell(value ? std::optional(value->median) : std::nullopt, digits);
}

std::string spreadCell(const std::optional<BenchSamples>& value) {
    return value ? fmt::format("{:.2f}..{:.2f}", value->lowest, value->highest) : "-";
}

}  // namespace

std::string benchJson(const BenchReport& r) {
    Json json{{"scene", r.scene},
              {"triangles", r.triangles},
              {"device", r.device},
              {"build",
               {{"seconds", r.build_seconds},
                {"mtris_per_second", r.mtris_per_second},
                {"bytes_per_triangle", r.bytes_per_triangle},
                {"depth", r.depth},
                {"nodes", r.nodes},
                {"quality", r.quality},
                {"sah_cost", r.sah_cost},
                {"embree_seconds", orNull(r.embree_build_seconds)}}},
              {"rays", Json::array()},
              {"driver", r.driver},
              {"width", r.size.x},
              {"height", r.size.y},
              {"runs", r.runs},
              {"cores", r.cores},
              {"timing", "wall clock around submissions"},
              {"glossy_roughness", kRecordedRoughness},
              {"embree", r.embree_version.empty() ? Json(nullptr) : Json(r.embree_version)}};
    for (const BenchKind& kind : r.kinds) json["rays"].push_back(kindJson(kind));
    return jsonText(json);
}

std::string benchText(const BenchReport& r) {
    std::string text = fmt::format("{}: {} triangles, {}x{} paths, {} runs on {}\n", r.scene, r.triangles,
                                   r.size.x, r.size.y, r.runs, r.device);
    text += fmt::format(
        "BVH ({}): {:.3f} s, {:.2f} Mtris/s, {:.1f} bytes/triangle, {} nodes, depth {}, SAH cost {:.1f}\n",
        r.quality, r.build_seconds, r.mtris_per_second, r.bytes_per_triangle, r.nodes, r.depth, r.sah_cost);
    if (r.embree_build_seconds)
        text += fmt::format("Embree {}: {:.3f} s, {} cores; its rays one by one (1) and in packets (p)\n",
                            r.embree_version, *r.embree_build_seconds, r.cores);
    else
        text += "Embree is not installed (libembree-dev): nothing to compare with\n";
    text += fmt::format("{:<8}{:>9}{:>9}{:>9}{:>8}{:>13}{:>8}{:>8} {:<12}{:>8}{:>7}{:>7}\n", "rays", "count",
                        "Mrays/s", "Embree1", "ratio", "spread", "by cpu", "ratio p", "packet", "differ",
                        "nodes", "tris");
    for (const BenchKind& k : r.kinds) {
        text += fmt::format("{:<8}{:>9}{:>9}{:>9}{:>8}{:>13}{:>8}{:>8} {:<12}{:>8}{:>7}{:>7}\n", k.kind,
                            k.count, cell(k.mrays, 2), cell(k.embree1_mrays, 2), cell(k.embree1_ratio, 3),
                            spreadCell(k.embree1_ratio), cell(k.embree1_cpu_ratio, 3),
                            cell(k.embree_packet_ratio, 3), k.packet_call.empty() ? "-" : k.packet_call,
                            k.mismatches ? fmt::format("{}", *k.mismatches) : "-", cell(k.nodes_per_ray, 1),
                            cell(k.triangles_per_ray, 1));
    }
    for (const BenchKind& k : r.kinds) {
        if (k.truncated_traversals > 0)
            text += fmt::format("warning: the driver truncated {} traversals of {} rays\n",
                                k.truncated_traversals, k.kind);
        if (k.embree_leaks.value_or(0) > 0)
            text += fmt::format(
                "{}: {} rays slipped through edges in Embree's default mode and not in its robust one\n",
                k.kind, *k.embree_leaks);
    }
    return text;
}

}  // namespace licht
