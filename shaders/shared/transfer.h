// The transfer curve of IEC 61966-2-1:1999 (sRGB), per channel, with the standard's own rounded constants; encoded and linear in [0,1].
#ifndef LICHT_SHARED_TRANSFER_H
#define LICHT_SHARED_TRANSFER_H
#include "seam.h"

LICHT_SHARED_BEGIN

LICHT_FUNCTION float linearFromSrgb(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : pow((encoded + 0.055f) / 1.055f, 2.4f);
}

LICHT_FUNCTION float srgbFromLinear(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * pow(linear, 1.0f / 2.4f) - 0.055f;
}

LICHT_SHARED_END
#endif
