#pragma once
#include "licht/core/math.h"

namespace licht {

/// What the channels of a picture mean: CIE 1931 chromaticities (x, y) of red, green, blue and white.
struct Primaries {
    glm::dvec2 red{0.64, 0.33};  ///< the defaults are Rec. 709's (ITU-R BT.709)
    glm::dvec2 green{0.30, 0.60};
    glm::dvec2 blue{0.15, 0.06};
    glm::dvec2 white{0.3127, 0.3290};
};

/// Whether they are Rec. 709's as far as files give digits.
bool areRec709(const Primaries& primaries);

/// CIE 1931 XYZ of linear values of these primaries, white of luminance one.
glm::dmat3 xyzFromRgb(const Primaries& primaries);

/// Linear Rec. 709 from linear values of these primaries, white to white by the Bradford transform (Lam 1985;
/// ICC.1:2022, annex E). The matrix is not finite where the primaries span no triangle.
glm::dmat3 rec709FromPrimaries(const Primaries& primaries);

}  // namespace licht
