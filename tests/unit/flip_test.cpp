// LDR-FLIP: closed forms where colours or features stand alone, what any such measure has to keep, and
// numbers of the authors' own tool.
#include "licht/measure/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace licht {
namespace {

using Formula = std::function<float(int x, int y, int channel)>;

constexpr int kWidth = 24;
constexpr int kHeight = 18;

Image drawn(int width, int height, const Formula& formula) {
    Image image(width, height, 3);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c) image.at(x, y, c) = formula(x, y, c);
    return image;
}

Image drawn(const Formula& formula) {
    return drawn(kWidth, kHeight, formula);
}

Image grey(float value) {
    return drawn([value](int, int, int) { return value; });
}

// Sixteenths and 128ths are the same floats everywhere.
Image mosaic(int across, int down, int channel) {
    return drawn([=](int x, int y, int c) {
        return static_cast<float>((across * x + down * y + channel * c) % 17) / 16.0F;
    });
}

Image ramp(int unrest) {
    return drawn([unrest](int x, int y, int c) {
        return static_cast<float>(x + 2 * y + 4 * c + (x * y + c) % unrest) / 128.0F;
    });
}

Image transposed(const Image& image) {
    Image result(image.height, image.width, image.channels);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < image.channels; ++c) result.at(y, x, c) = image.at(x, y, c);
    return result;
}

float largestOf(const Image& map) {
    return *std::max_element(map.texels.begin(), map.texels.end());
}

/// HyAB of green and blue after Hunt, from CIELAB of Rec. 709's primaries under D65 (0.31271, 0.32902), to
/// the power 0.7: L, 0.01 L a, 0.01 L b are (87.73621, -75.60993, 72.98123) and (32.29817, 25.57808,
/// -34.83637), so it is (55.43804 + sqrt(101.18801^2 + 107.81760^2))^0.7.
const double kGreenToBlue = std::pow(55.43804 + std::hypot(101.18801, 107.81760), 0.7);

/// The colour error of two greys whose CIELAB lightnesses differ by so much.
double greyError(double lightness_difference) {
    const double distance = std::pow(lightness_difference, 0.7);
    const double knee = 0.4 * kGreenToBlue;
    return distance < knee ? 0.95 * distance / knee : 0.95 + 0.05 * (distance - knee) / (kGreenToBlue - knee);
}

// Half a unit in the last place of a float below one is 3e-8; the printed digits of kGreenToBlue (1e-5 of
// 203 in each of three terms) make 1e-7 of an error.
constexpr double kRounding = 2e-7;

TEST(Flip, EqualPicturesDoNotDiffer) {
    for (const Image& image : {grey(0.0F), grey(0.3F), mosaic(7, 13, 5), ramp(4)}) {
        EXPECT_EQ(flip(image, image), 0.0);
        EXPECT_EQ(largestOf(flipMap(image, image)), 0.0F);
    }
}

TEST(Flip, TheDefaultIsThePapersViewer) {
    // At 0.7 m a degree spans 0.7 pi / 180 m, of which a metre of that monitor has 3840 / 0.7 pixels.
    EXPECT_DOUBLE_EQ(kFlipPixelsPerDegree, 3840.0 * std::numbers::pi / 180.0);
    const Image a = mosaic(7, 13, 5);
    const Image b = mosaic(5, 11, 3);
    EXPECT_EQ(flip(a, b), flip(a, b, 3840.0 * std::numbers::pi / 180.0));
}

TEST(Flip, PlainGreysDifferByTheirLightness) {
    // Nothing is filtered away and there are no features. White: L = 100, above the knee. The code 0.5 is
    // ((0.5 + 0.055) / 1.055)^2.4 = 0.21404114 linear, L = 116 cbrt(0.21404114) - 16, below it. The code 0.04
    // is 0.04 / 12.92 linear, where L = (29/3)^3 times that.
    const double half = 116.0 * std::cbrt(std::pow(0.555 / 1.055, 2.4)) - 16.0;
    const double dark = std::pow(29.0 / 3.0, 3.0) * 0.04 / 12.92;
    for (const double pixels_per_degree : {2.0, kFlipPixelsPerDegree, 150.0}) {
        EXPECT_NEAR(flip(grey(1.0F), grey(0.0F), pixels_per_degree), greyError(100.0), kRounding);
        EXPECT_NEAR(flip(grey(0.5F), grey(0.0F), pixels_per_degree), greyError(half), kRounding);
        EXPECT_NEAR(flip(grey(1.0F), grey(0.5F), pixels_per_degree), greyError(100.0 - half), kRounding);
        EXPECT_NEAR(flip(grey(0.04F), grey(0.0F), pixels_per_degree), greyError(dark), kRounding);
    }
    EXPECT_NEAR(greyError(100.0), 0.96738, 1e-6);
}

TEST(Flip, GreenAndBlueAreFarthestApart) {
    const auto pure = [](int channel) {
        return drawn([channel](int, int, int c) { return c == channel ? 1.0F : 0.0F; });
    };
    EXPECT_NEAR(flip(pure(1), pure(2)), 1.0, kRounding);
    // Red is (53.23, 0.5323 * 80.11, 0.5323 * 67.22) after Hunt: 34.5 and |(118.2, -37.2)| from green, 20.9
    // and |(17.1, 70.6)| from blue. Without Hunt's factor the greatest is another, too.
    const double to_green = std::pow(34.5 + std::hypot(118.2, 37.2), 0.7);
    const double to_blue = std::pow(20.9 + std::hypot(17.1, 70.6), 0.7);
    const auto error = [](double distance) {
        const double knee = 0.4 * kGreenToBlue;
        return 0.95 + 0.05 * (distance - knee) / (kGreenToBlue - knee);
    };
    // A tenth in each of three terms moves the error by 3e-4 * 0.3.
    EXPECT_NEAR(flip(pure(0), pure(1)), error(to_green), 1e-4);
    EXPECT_NEAR(flip(pure(0), pure(2)), error(to_blue), 1e-4);
}

/// Of black and white: where colours differ, by features that differ so much.
double withFeature(double difference) {
    return std::pow(greyError(100.0), 1.0 - std::sqrt(difference / std::numbers::sqrt2));
}

// With one pixel a degree an eye resolves each pixel by itself (the next one's weight is exp(-pi^2 / 0.04) =
// 1e-107), the first derivative is (-1, 0, 1), the second (1/2, -1, 1/2), and neither is blurred.

TEST(Flip, EdgesAndPointsOnAPixelGridAreExact) {
    const Image black = grey(0.0F);
    const Image edge = drawn([](int x, int, int) { return x >= 10 ? 1.0F : 0.0F; });
    const Image edge_map = flipMap(edge, black, 1.0);
    EXPECT_EQ(edge_map.at(9, 5, 0), 0.0F) << "an edge on alike colours is none";
    EXPECT_NEAR(edge_map.at(10, 5, 0), withFeature(1.0), kRounding);
    EXPECT_NEAR(edge_map.at(11, 5, 0), withFeature(0.0), kRounding);
    // A corner is an edge both ways: |(1, 1)|.
    const Image corner = drawn([](int x, int y, int) { return x >= 10 && y >= 7 ? 1.0F : 0.0F; });
    EXPECT_NEAR(flipMap(corner, black, 1.0).at(10, 7, 0), 1.0, kRounding);
    // A line has no edge in its middle, but 0/2 - 1 + 0/2; a dot has that both ways.
    const Image line = drawn([](int, int y, int) { return y == 7 ? 1.0F : 0.0F; });
    EXPECT_NEAR(flipMap(line, black, 1.0).at(10, 7, 0), withFeature(1.0), kRounding);
    const Image dot = drawn([](int x, int y, int) { return x == 10 && y == 7 ? 1.0F : 0.0F; });
    EXPECT_NEAR(flipMap(dot, black, 1.0).at(10, 7, 0), 1.0, kRounding);
    // The strongest feature is not seen where colours are alike.
    const Image hole = drawn([](int x, int y, int) { return x == 10 && y == 7 ? 0.0F : 1.0F; });
    EXPECT_EQ(flipMap(hole, black, 1.0).at(10, 7, 0), 0.0F);
    EXPECT_NEAR(flipMap(hole, black, 1.0).at(9, 7, 0), withFeature(1.0), kRounding);
    // A grey line, of linear 0.21404114: the features are of luminance, not of codes or lightness.
    const double linear = std::pow(0.555 / 1.055, 2.4);
    const double colour = greyError(116.0 * std::cbrt(linear) - 16.0);
    const Image grey_line = drawn([](int, int y, int) { return y == 7 ? 0.5F : 0.0F; });
    EXPECT_NEAR(flipMap(grey_line, black, 1.0).at(10, 7, 0),
                std::pow(colour, 1.0 - std::sqrt(linear / std::numbers::sqrt2)), kRounding);
}

TEST(Flip, BordersGoOnOutside) {
    // The border's columns are as if there were more of their kind outside. At 20 pixels a degree filters
    // reach 3 pixels.
    const auto leftOf = [](int x_end) {
        return drawn([x_end](int x, int, int) { return x < x_end ? 1.0F : 0.0F; });
    };
    const Image black = grey(0.0F);
    const Image border = flipMap(leftOf(1), black, 20.0);
    const Image inner = flipMap(leftOf(11), black, 20.0);
    for (int x = 0; x < 5; ++x) EXPECT_NEAR(border.at(x, 8, 0), inner.at(x + 10, 8, 0), kRounding) << x;
}

TEST(Flip, IsSymmetric) {
    EXPECT_EQ(flip(mosaic(7, 13, 5), mosaic(5, 11, 3)), flip(mosaic(5, 11, 3), mosaic(7, 13, 5)));
    EXPECT_EQ(flip(ramp(1), ramp(4)), flip(ramp(4), ramp(1)));
}

TEST(Flip, RowsAndColumnsAreAlike) {
    const Image test = ramp(5);
    const Image reference = ramp(1);
    const Image map = flipMap(test, reference);
    const Image turned = transposed(flipMap(transposed(test), transposed(reference)));
    ASSERT_EQ(turned.width, kWidth);
    // Rounding to floats on another way moves each of four filtered values by at most 6e-8, hence the error
    // f of features by d = sqrt(4 * 6e-8 / sqrt(2)) = 4e-4 where there are none. c^(1 - f) has a slope of at
    // most 1 / (e (1 - f)) by f, whatever c is, and here f stays below 1/2.
    for (std::size_t i = 0; i < map.texels.size(); ++i) EXPECT_NEAR(map.texels[i], turned.texels[i], 3e-4);
}

TEST(Flip, GrowsWithTheError) {
    const Image reference = ramp(1);
    double last = 0.0;
    for (const int step : {1, 2, 4, 8, 16}) {
        Image test = reference;
        for (std::size_t i = 0; i < test.texels.size(); i += 2)
            test.texels[i] += static_cast<float>(step) / 128.0F;
        const double error = flip(test, reference);
        EXPECT_GT(error, last) << step;
        last = error;
    }
}

TEST(Flip, AnEdgeThatMovedIsSeenMoreThanAGradient) {
    const auto edge = [](int at) { return drawn([at](int x, int, int) { return x < at ? 0.25F : 0.75F; }); };
    const auto gradient = [](int at) {
        return drawn([at](int x, int, int) { return 0.25F + static_cast<float>(x - at + 1) / 64.0F; });
    };
    EXPECT_GT(largestOf(flipMap(edge(13), edge(12))), 3.0F * largestOf(flipMap(gradient(1), gradient(0))));
}

TEST(Flip, FineNoiseIsSeenLessFromAfar) {
    const Image a = mosaic(7, 13, 5);
    const Image b = mosaic(5, 11, 3);
    EXPECT_GT(flip(a, b, 20.0), 1.1 * flip(a, b));
    EXPECT_GT(flip(a, b), 1.1 * flip(a, b, 150.0));
}

TEST(Flip, AgreesWithTheAuthorsTool) {
    // flip-evaluator 1.7 of NVIDIA (pypi.org/project/flip-evaluator), evaluate(reference, test, "LDR",
    // applyMagma=False, parameters={"ppd": 20}) or without ppd; the mean of its map. It adds up floats, 21
    // weights in each of two directions, each sum to half a unit in the last place, 6e-8 of one at most.
    constexpr double tolerance = 42 * 6e-8;
    EXPECT_NEAR(flip(mosaic(5, 11, 3), mosaic(7, 13, 5)), 0.3577585, tolerance);
    EXPECT_NEAR(flip(mosaic(5, 11, 3), mosaic(7, 13, 5), 20.0), 0.8051021, tolerance);
    EXPECT_NEAR(flip(ramp(4), ramp(1)), 0.0808159, tolerance);
    EXPECT_NEAR(flip(ramp(4), ramp(1), 20.0), 0.0866684, tolerance);
}

}  // namespace
}  // namespace licht
