#pragma once
#include "licht/core/math.h"
#include "licht/shared/transfer.h"  // linearFromSrgb, srgbFromLinear

namespace licht {

/// Luminance of linear Rec. 709 (ITU-R BT.709, weights 0.2126, 0.7152, 0.0722).
float luminance(const vec3& linear);

}  // namespace licht
