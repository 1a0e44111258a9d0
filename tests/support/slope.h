#pragma once
#include <cmath>
#include <cstddef>
#include <vector>

namespace licht {

/// Least squares line of log2(error) over log2(samples), where each error is of twice the samples of the one
/// before.
inline double slopeOf(const std::vector<double>& errors) {
    const double middle = 0.5 * (static_cast<double>(errors.size()) - 1.0);
    double xy = 0.0;
    double xx = 0.0;
    for (std::size_t i = 0; i < errors.size(); ++i) {
        const double x = static_cast<double>(i) - middle;
        xy += x * std::log2(errors[i]);
        xx += x * x;
    }
    return xy / xx;
}

}  // namespace licht
