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

/// For each pixel of `now` 1 where its surface was outside the picture `before`, or behind what that showed
/// in its place.
std::vector<std::uint8_t> findDisoccluded(const SeenDepths& before, const SeenDepths& now);

}  // namespace licht
