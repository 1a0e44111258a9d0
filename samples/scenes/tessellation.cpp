#include "samples/scenes/tessellation.h"

#include <algorithm>
#include <cmath>

namespace licht {

GridCut cutGrid(std::uint64_t triangles) {
    const std::uint64_t quads = std::max<std::uint64_t>(1, triangles / 2);
    const auto side = static_cast<std::uint64_t>(std::sqrt(static_cast<double>(quads)));
    GridCut best{1, static_cast<std::uint32_t>(quads)};
    std::uint64_t least = quads;
    for (std::uint64_t columns = std::max<std::uint64_t>(1, side - side / 8); columns <= side + side / 8 + 1;
         ++columns) {
        const std::uint64_t rows = std::max<std::uint64_t>(1, (quads + columns / 2) / columns);
        const std::uint64_t missing =
            quads > columns * rows ? quads - columns * rows : columns * rows - quads;
        if (missing >= least) continue;
        least = missing;
        best = {static_cast<std::uint32_t>(columns), static_cast<std::uint32_t>(rows)};
    }
    return best;
}

SphereCut cutSphere(std::uint64_t triangles) {
    // Twice as many segments as bands give quads that are square at the equator.
    const double bands = std::max(2.0, std::round(std::sqrt(static_cast<double>(triangles) / 4.0)));
    const double segments = std::max(6.0, std::round(static_cast<double>(triangles) / (2.0 * bands)));
    return {static_cast<std::uint32_t>(segments), static_cast<std::uint32_t>(bands) + 1};
}

}  // namespace licht
