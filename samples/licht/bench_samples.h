#pragma once
#include <algorithm>
#include <optional>
#include <vector>

namespace licht {

/// A quantity measured several times.
struct BenchSamples {
    double median = 0.0;
    double lowest = 0.0;
    double highest = 0.0;
};

/// nullopt of nothing.
inline std::optional<BenchSamples> summarise(std::vector<double> values) {
    if (values.empty()) return std::nullopt;
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    const double median = values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
    return BenchSamples{median, values.front(), values.back()};
}

}  // namespace licht
