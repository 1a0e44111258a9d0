#pragma once
// What a view shows and the one before did not, told by depths alone.
#include <cstdint>
#include <vector>

#include "licht/image/image.h"
#include "licht/render/view.h"

namespace licht {

struct SeenDepths {
    const ViewRecord& view;
    const Image& depth;  ///< one channel: along the axis, metres; infinite: nothing
};

inline constexpr std::uint32_t kNotSeen = ~0U;

/// For each pixel of `now` the pixel, by its number row after row, in which its surface lies in the picture
/// `before`; kNotSeen where that is outside, or behind what was shown there. Where nothing is shown, itself.
std::vector<std::uint32_t> findBefore(const SeenDepths& before, const SeenDepths& now);

}  // namespace licht
