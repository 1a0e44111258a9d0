#pragma once
// Curves as a picture that a browser shows.
#include <string>
#include <utility>
#include <vector>

namespace licht {

struct Curve {
    std::string name;
    std::vector<std::pair<double, double>> points;
};

struct Plot {
    std::string title, x, y;
    std::vector<Curve> curves;
};

/// SVG; y is logarithmic, and points without a logarithm are left out.
std::string svgText(const Plot& plot);

}  // namespace licht
