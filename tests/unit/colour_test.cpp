#include <gtest/gtest.h>

#include <cmath>

#include "licht/colour/primaries.h"
#include "licht/colour/transfer.h"

namespace licht {
namespace {

TEST(Transfer, RoundTripOfAllEightBitCodesIsExactAndMonotone) {
    float last = -1.0F;
    for (int code = 0; code <= 255; ++code) {
        const float linear = linearFromSrgb(static_cast<float>(code) / 255.0F);
        EXPECT_GT(linear, last);
        last = linear;
        EXPECT_EQ(std::lround(srgbFromLinear(linear) * 255.0F), code);
    }
}

TEST(Transfer, KnownValues) {
    EXPECT_EQ(linearFromSrgb(0.0F), 0.0F);
    EXPECT_EQ(srgbFromLinear(0.0F), 0.0F);
    EXPECT_EQ(linearFromSrgb(1.0F), 1.0F);
    // One subtraction after a power: two roundings of values near 1.
    EXPECT_NEAR(srgbFromLinear(1.0F), 1.0F, 2.0F * 1.1920929e-7F);
    // ((0.5 + 0.055) / 1.055)^2.4 = 0.214041140482..., to the rounding of the power's argument.
    EXPECT_NEAR(linearFromSrgb(0.5F), 0.2140411405F, 0.2140411405F * 4.0F * 1.1920929e-7F);
    // The linear part: 0.04 / 12.92.
    EXPECT_FLOAT_EQ(linearFromSrgb(0.04F), 0.00309597523F);
}

TEST(Transfer, BothPartsMeet) {
    // The standard rounds its constants; the two parts differ by 3e-8 at the joint, less than half a 16-bit
    // step (7.6e-6).
    const float joint = 0.0031308F;
    EXPECT_NEAR(srgbFromLinear(joint), srgbFromLinear(std::nextafter(joint, 1.0F)), 0.5F / 65535.0F);
}

TEST(Luminance, WeightsOfRec709) {
    EXPECT_FLOAT_EQ(luminance({1.0F, 0.0F, 0.0F}), 0.2126F);
    EXPECT_FLOAT_EQ(luminance({0.0F, 1.0F, 0.0F}), 0.7152F);
    EXPECT_FLOAT_EQ(luminance({0.0F, 0.0F, 1.0F}), 0.0722F);
    EXPECT_FLOAT_EQ(luminance(vec3(3.0F)), 3.0F);
}

TEST(Primaries, XyzOfRec709IsThatOfItsStandard) {
    const glm::dmat3 xyz_from_rgb = xyzFromRgb(Primaries{});
    // The matrix of IEC 61966-2-1:1999, to its four digits: X, Y and Z of red, green and blue.
    const double printed[3][3] = {
        {0.4124, 0.2126, 0.0193}, {0.3576, 0.7152, 0.1192}, {0.1805, 0.0722, 0.9505}};
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            EXPECT_NEAR(xyz_from_rgb[column][row], printed[column][row], 0.5e-4) << column << " " << row;
}

}  // namespace
}  // namespace licht
