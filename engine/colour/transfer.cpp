#include "licht/colour/transfer.h"

#include <cmath>

namespace licht {

// IEC 61966-2-1:1999, "Default RGB colour space - sRGB", with the standard's own rounded constants.
float linearFromSrgb(float encoded) {
    return encoded <= 0.04045F ? encoded / 12.92F : std::pow((encoded + 0.055F) / 1.055F, 2.4F);
}

float srgbFromLinear(float linear) {
    return linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1.0F / 2.4F) - 0.055F;
}

float luminance(const vec3& linear) {
    return glm::dot(linear, vec3(0.2126F, 0.7152F, 0.0722F));
}

}  // namespace licht
