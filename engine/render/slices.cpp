#include "licht/render/slices.h"

#include <algorithm>

namespace licht {

std::uint32_t rowsPerSlice(double seconds, double rows_done, std::uint32_t most_rows) {
    // A submission that runs longer than this meets the watchdogs of desktop systems (about two seconds) on a
    // slow moment.
    constexpr double kSliceSeconds = 0.1;
    if (seconds <= 0.0 || rows_done <= 0.0) return std::min(most_rows, 128U);
    const double rows =
        std::clamp(kSliceSeconds * rows_done / seconds, 8.0, std::max(8.0, static_cast<double>(most_rows)));
    return static_cast<std::uint32_t>(rows);
}

}  // namespace licht
