#include "licht/run/recovery.h"

#include <algorithm>
#include <cmath>

namespace licht {

void Recovery::add(std::uint32_t frames_since, const RecoveryStep& step) {
    if (steps.size() <= frames_since) steps.resize(frames_since + 1);
    steps[frames_since].error += step.error;
    steps[frames_since].fresh_error += step.fresh_error;
    steps[frames_since].pixels += step.pixels;
}

std::optional<std::uint32_t> Recovery::frames() const {
    for (std::uint32_t since = 0; since < steps.size(); ++since)
        if (steps[since].pixels > 0 && steps[since].error <= kRecovered * steps[since].fresh_error)
            return since;
    return std::nullopt;
}

void SurfaceAges::advance(const std::optional<SeenDepths>& before, const SeenDepths& now) {
    std::vector<std::uint32_t> ages(now.depth.texels.size(), kUnknown);
    if (before) {
        const std::vector<std::uint32_t> places = findBefore(*before, now);
        for (std::size_t pixel = 0; pixel < ages.size(); ++pixel) {
            if (!std::isfinite(now.depth.texels[pixel])) continue;
            const std::uint32_t place = places[pixel];
            if (place == kNotSeen)
                ages[pixel] = 0;
            else if (ages_[place] != kUnknown)
                ages[pixel] = ages_[place] + 1;
        }
    }
    ages_ = std::move(ages);
}

void FreshStarts::advance(bool cut, bool light_changed, bool uncovered) {
    if (watches()) ++since_;
    if (!cut && !light_changed && (watches() || !uncovered)) return;
    since_ = 0;
    kind_ = cut ? ChangeKind::cut : light_changed ? ChangeKind::light : ChangeKind::disocclusion;
}

bool FreshStarts::touched(std::uint32_t age) const {
    return kind_ != ChangeKind::disocclusion || age == since_;
}

}  // namespace licht
