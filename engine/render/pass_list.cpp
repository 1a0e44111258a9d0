#include "licht/render/pass_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>

namespace licht {
namespace {

constexpr auto kPasses = std::to_array<PassInfo>({
    {PassId::gbuffer, "gbuffer", false},
    {PassId::path, "path", true},
    {PassId::path_clear, "path clear", true},
    {PassId::path_start, "path start", true},
    {PassId::path_prepare, "path prepare", true},
    {PassId::path_shade, "path shade", true},
    {PassId::path_shadow, "path shadow", true},
    {PassId::path_trace, "path trace", true},
    {PassId::path_finish, "path finish", true},
    {PassId::accumulate, "accumulate", false},
    {PassId::layers, "layers", false},
    {PassId::signals, "signals", false},
    {PassId::history_gradient, "history gradient", false},
    {PassId::history_spread, "history spread", false},
    {PassId::history_fold, "history fold", false},
    {PassId::history_reproject, "history reproject", false},
    {PassId::history_edges, "history edges", false},
    {PassId::history_parts, "history parts", false},
    {PassId::filter_guide, "filter guide", false},
    {PassId::filter_begin, "filter begin", false},
    {PassId::filter_smooth, "filter smooth", false},
    {PassId::filter_level, "filter level", false},
    {PassId::filter_bias, "filter bias", false},
    {PassId::filter_end, "filter end", false},
    {PassId::filter_resolve, "filter resolve", false},
    {PassId::tonemap, "tonemap", false},
});

constexpr bool inOrder() {
    for (std::size_t i = 0; i < kPasses.size(); ++i)
        if (kPasses[i].id != static_cast<PassId>(i)) return false;
    return kPasses.size() == static_cast<std::size_t>(PassId::tonemap) + 1;
}
static_assert(inOrder());

const PassInfo& infoOf(PassId id) {
    return kPasses[static_cast<std::size_t>(id)];
}

double secondsOf(const PassTimes& times, const std::string& name) {
    const auto found = times.find(name);
    return found == times.end() ? 0.0 : found->second.seconds;
}

/// "path shade 3" -> "path shade"
std::string_view withoutBounce(std::string_view name) {
    const std::size_t last = name.find_last_not_of("0123456789");
    const bool numbered = last != std::string_view::npos && last + 1 < name.size() && name[last] == ' ';
    return numbered ? name.substr(0, last) : name;
}

}  // namespace

std::span<const PassInfo> passList() {
    return kPasses;
}

std::string passName(PassId id) {
    return std::string(infoOf(id).name);
}

std::string passName(PassId id, std::uint32_t bounce) {
    return fmt::format("{} {}", infoOf(id).name, bounce);
}

void addTimes(PassTimes& sums, const PassTimes& times) {
    for (const auto& [name, time] : times) {
        sums[name].seconds += time.seconds;
        sums[name].count += time.count;
    }
}

double passSeconds(const PassTimes& times, PassId id) {
    return secondsOf(times, passName(id));
}

double passSeconds(const PassTimes& times, PassId id, std::uint32_t bounce) {
    return secondsOf(times, passName(id, bounce));
}

double pathSeconds(const PassTimes& times) {
    double seconds = 0.0;
    for (const auto& [name, time] : times) {
        const auto known = std::find_if(kPasses.begin(), kPasses.end(), [&name = name](const PassInfo& pass) {
            return pass.name == withoutBounce(name);
        });
        if (known != kPasses.end() && known->follows_paths) seconds += time.seconds;
    }
    return seconds;
}

}  // namespace licht
