#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "licht/core/math.h"
#include "samples/licht/bench_samples.h"

namespace licht {

/// Rays of one kind. What could not be measured is nullopt.
struct BenchKind {
    std::string kind;
    std::uint64_t count = 0;
    std::optional<BenchSamples> mrays;                ///< millions of rays a second on the device
    std::optional<BenchSamples> embree1_mrays;        ///< one by one, all cores
    std::optional<BenchSamples> embree_packet_mrays;  ///< the fastest packet call
    std::string packet_call;                          ///< "8", "16 coherent"
    std::optional<BenchSamples> embree1_ratio;        ///< device over Embree, run by run
    /// The same by processor time, which a busy machine disturbs less; where the device is the processor.
    std::optional<BenchSamples> embree1_cpu_ratio;
    std::optional<BenchSamples> embree_packet_ratio;
    std::optional<std::uint64_t> mismatches;  ///< against Embree
    std::optional<std::uint64_t>
        embree_leaks;  ///< of Embree's default mode: its robust mode sides with the device
    std::uint64_t truncated_traversals = 0;  ///< ended by the driver before they were done
    std::optional<double> nodes_per_ray;
    std::optional<double> triangles_per_ray;
};

struct BenchReport {
    std::string scene;
    std::uint64_t triangles = 0;
    std::string device;
    std::string driver;
    uvec2 size{0};
    std::uint32_t runs = 0;
    std::uint32_t cores = 0;
    std::string quality;  ///< of the BVH
    double build_seconds = 0.0;
    double mtris_per_second = 0.0;
    double bytes_per_triangle = 0.0;
    std::uint32_t depth = 0;
    std::uint64_t nodes = 0;
    double sah_cost = 0.0;
    std::string embree_version;  ///< empty: not installed
    std::optional<double> embree_build_seconds;
    std::vector<BenchKind> kinds;
};

std::string benchJson(const BenchReport& report);
/// For people: a few lines and a table.
std::string benchText(const BenchReport& report);

}  // namespace licht
