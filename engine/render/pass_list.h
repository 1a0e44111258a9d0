#pragma once
// The names of a frame's passes, as timers and reports know them.
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "licht/gpu/commands.h"

namespace licht {

enum class PassId {
    gbuffer,
    path,
    path_clear,
    path_start,
    path_prepare,
    path_shade,
    path_shadow,
    path_trace,
    path_finish,
    accumulate,
    layers,
    signals,
    history_gradient,
    history_spread,
    history_fold,
    history_reproject,
    history_edges,
    history_parts,
    filter_guide,
    filter_begin,
    filter_smooth,
    filter_level,
    filter_bias,
    filter_end,
    filter_resolve,
    tonemap,
};

struct PassInfo {
    PassId id;
    std::string_view name;
    bool follows_paths;  ///< runs once a slice, whose rows its time grows with
};

/// In the order of their ids.
std::span<const PassInfo> passList();

std::string passName(PassId id);
/// Where passes are told apart by the bounce.
std::string passName(PassId id, std::uint32_t bounce);

using PassTimes = std::map<std::string, gpu::PassTime>;

void addTimes(PassTimes& sums, const PassTimes& times);

/// Zero where it did not run.
double passSeconds(const PassTimes& times, PassId id);
double passSeconds(const PassTimes& times, PassId id, std::uint32_t bounce);
/// Of all passes that follow paths, whatever the bounce.
double pathSeconds(const PassTimes& times);

}  // namespace licht
