#include "licht/colour/primaries.h"

#include <cmath>

namespace licht {
namespace {

using glm::dmat3;
using glm::dvec2;
using glm::dvec3;

/// XYZ of luminance one.
dvec3 xyzOf(const dvec2& xy) {
    return {xy.x / xy.y, 1.0, (1.0 - xy.x - xy.y) / xy.y};
}

dmat3 adaptation(const dvec2& from_white, const dvec2& to_white) {
    const dmat3 cones_from_xyz =
        glm::transpose(dmat3(0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296));
    const dvec3 gain = (cones_from_xyz * xyzOf(to_white)) / (cones_from_xyz * xyzOf(from_white));
    const dmat3 scaled(dvec3(gain.x, 0, 0), dvec3(0, gain.y, 0), dvec3(0, 0, gain.z));
    return glm::inverse(cones_from_xyz) * scaled * cones_from_xyz;
}

}  // namespace

bool areRec709(const Primaries& p) {
    constexpr double kDigits = 1e-4;
    const Primaries rec709;
    const auto near = [](const dvec2& a, const dvec2& b) {
        return std::abs(a.x - b.x) <= kDigits && std::abs(a.y - b.y) <= kDigits;
    };
    return near(p.red, rec709.red) && near(p.green, rec709.green) && near(p.blue, rec709.blue) &&
           near(p.white, rec709.white);
}

glm::dmat3 xyzFromRgb(const Primaries& p) {
    const dmat3 primaries(xyzOf(p.red), xyzOf(p.green), xyzOf(p.blue));
    // The luminances of the primaries are those that add up to white.
    const dvec3 luminances = glm::inverse(primaries) * xyzOf(p.white);
    return {primaries[0] * luminances.x, primaries[1] * luminances.y, primaries[2] * luminances.z};
}

glm::dmat3 rec709FromPrimaries(const Primaries& primaries) {
    const Primaries rec709;
    return glm::inverse(xyzFromRgb(rec709)) * adaptation(primaries.white, rec709.white) *
           xyzFromRgb(primaries);
}

}  // namespace licht
