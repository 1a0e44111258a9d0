#include "samples/licht/options.h"

#include <gtest/gtest.h>

#include "licht/core/error.h"
#include "licht/settings/settings.h"

namespace licht {
namespace {

TEST(ParseSize, TakesWhatIsInRange) {
    const auto parsed = [](const char* text) {
        const SizeRequest size = parseSize("--size", text);
        return uvec2(size.width, size.height);
    };
    EXPECT_EQ(parsed("960x540"), uvec2(960, 540));
    EXPECT_EQ(parsed("1x1"), uvec2(1, 1));
    EXPECT_EQ(parsed("16384x8192"), uvec2(16384, 8192));  // 2^27 pixels exactly
    EXPECT_EQ(parsed("1920"), uvec2(1920, 0));
    EXPECT_EQ(parsed("1920x"), uvec2(1920, 0));
    EXPECT_EQ(parsed("x1080"), uvec2(0, 1080));
    for (const char* bad : {"", "x", "0", "16385", "x0", "xx", "0x1", "1x0", "16385x1", "16384x8193", "-1x1",
                            "1x1x1", "1X1", " 1x1", "1x1 ", "1.5x1", "+1x1"})
        EXPECT_THROW(parseSize("--size", bad), InputError) << bad;
}

TEST(WholeNumber, TakesOneSignOfEitherKind) {
    EXPECT_EQ(wholeNumber<double>("+1.5"), 1.5);
    EXPECT_EQ(wholeNumber<double>("-1.5"), -1.5);
    EXPECT_EQ(wholeNumber<int>("+7"), 7);
    for (const char* text : {"", "+", "++1", "+-1", "-+1", "1+", " 1", "+ 1"})
        EXPECT_FALSE(wholeNumber<double>(text)) << text;
}

TEST(ParseCount, TakesWhatIsInRange) {
    EXPECT_EQ(parseCount32("--spp", "4294967295", 1, 4294967295U), 4294967295U);
    EXPECT_EQ(parseCount("--spp", "3", 3, 3), 3U);
    for (const char* bad : {"", "2", "4", "-3", "3.0", "3 ", "0x3", "99999999999999999999999"})
        EXPECT_THROW(parseCount("--spp", bad, 3, 3), InputError) << bad;
}

TEST(ParsePositive, RefusesZeroAndWhatIsNotFinite) {
    EXPECT_DOUBLE_EQ(parsePositive("--time", "1.5e-3"), 1.5e-3);
    for (const char* bad : {"", "0", "-0.0", "-1", "inf", "nan", "1e999", "1s"})
        EXPECT_THROW(parsePositive("--time", bad), InputError) << bad;
}

TEST(ParsePositiveFloat, RefusesWhatAFloatDoesNotHold) {
    EXPECT_EQ(parsePositiveFloat("--clamp", "0.25"), 0.25F);
    for (const char* bad : {"", "0", "-1", "inf", "nan", "1e39", "1e-60", "1,0"})
        EXPECT_THROW(parsePositiveFloat("--clamp", bad), InputError) << bad;
}

TEST(BlueBits, CoverTheSamplesOfAPixel) {
    EXPECT_EQ(blueBitsFor(std::nullopt), 4U);
    EXPECT_EQ(blueBitsFor(1U), 0U);
    EXPECT_EQ(blueBitsFor(2U), 1U);
    EXPECT_EQ(blueBitsFor(5U), 3U);
    EXPECT_EQ(blueBitsFor(8U), 3U);
    EXPECT_EQ(blueBitsFor(1024U), 10U);
    EXPECT_EQ(blueBitsFor(4294967295U), 10U);
}

TEST(ParseColour, TakesThreeNumbers) {
    EXPECT_EQ(parseColour("--background", "0,0.5,1e3"), vec3(0.0F, 0.5F, 1000.0F));
    for (const char* bad : {"", "1", "1,1", "1,1,1,1", "1,,1", "1,1,-1", "1,1,inf", "1,1,1e40", "a,b,c"})
        EXPECT_THROW(parseColour("--background", bad), InputError) << bad;
}

TEST(ParseLayers, TakesNamesOrAll) {
    EXPECT_EQ(parseLayers("--aov", "albedo,sampleCount"), (LayerSet{LayerId::albedo, LayerId::sample_count}));
    EXPECT_EQ(parseLayers("--aov", "all"), allLayers());
    for (const char* bad : {"", "albedo,", "Albedo", "albedo,all"})
        EXPECT_THROW(parseLayers("--aov", bad), InputError) << bad;
}

TEST(ParseOutput, KnowsTwoEndings) {
    EXPECT_EQ(parseOutput("-o", "a/b.PNG"), "a/b.PNG");
    EXPECT_EQ(parseOutput("-o", "b.exr"), "b.exr");
    for (const char* bad : {"", ".png", "a", "a.jpg", "a.png.gz"})
        EXPECT_THROW(parseOutput("-o", bad), InputError) << bad;
}

TEST(ParseChoices, KnowTheirNames) {
    EXPECT_EQ(parseChoice<Tonemap>("--tonemap", "agx"), Tonemap::agx);
    EXPECT_EQ(parseChoice<DirectLight>("--direct", "hemisphere"), DirectLight::hemisphere);
    EXPECT_THROW(parseChoice<Tonemap>("--tonemap", "AGX"), InputError);
    EXPECT_THROW(parseChoice<DirectLight>("--direct", ""), InputError);
}

TEST(Parsers, NameOptionAndValue) {
    try {
        parseSize("--size", "0x0");
        FAIL() << "no error";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("--size '0x0'"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace licht
