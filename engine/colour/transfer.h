#pragma once
#include "licht/core/math.h"

namespace licht {

/// IEC 61966-2-1 (sRGB) transfer function and its inverse, per channel; encoded and linear in [0,1].
float linearFromSrgb(float encoded);
float srgbFromLinear(float linear);

/// Luminance of linear Rec. 709 (ITU-R BT.709, weights 0.2126, 0.7152, 0.0722).
float luminance(const vec3& linear);

}  // namespace licht
