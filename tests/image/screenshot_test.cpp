// The built-in scenes against stored means and variances (tests/image/references, made by
// update_references.sh with another seed).
#include <gtest/gtest.h>

#include <algorithm>

#include "licht/film/film.h"
#include "licht/image/exr.h"
#include "licht/measure/ztest.h"
#include "licht/settings/settings.h"
#include "samples/scenes/builtin.h"
#include "support/render_test.h"

namespace licht {
namespace {

ExrPicture readStored(const std::string& name) {
    return readExr(std::string(LICHT_REFERENCES) + "/" + name + ".exr");
}

Film readReference(const ExrPicture& picture) {
    Film film;
    film.size = uvec2(picture.width, picture.height);
    film.mean = Image(picture.width, picture.height, 4);
    film.variance = Image(picture.width, picture.height, 3);
    const char* const names[] = {"R", "G", "B", "A"};
    for (std::size_t c = 0; c < 4; ++c) {
        const ExrChannel* mean = picture.find(names[c]);
        EXPECT_NE(mean, nullptr);
        if (mean == nullptr) continue;
        for (std::size_t i = 0; i < mean->values.size(); ++i) film.mean.texels[4 * i + c] = mean->values[i];
        if (c == 3) continue;
        const ExrChannel* variance = picture.find(std::string("variance.") + names[c]);
        EXPECT_NE(variance, nullptr);
        if (variance == nullptr) continue;
        for (std::size_t i = 0; i < variance->values.size(); ++i)
            film.variance.texels[3 * i + c] = variance->values[i];
    }
    return film;
}

class Screenshot : public testing::TestWithParam<const char*> {};

TEST_P(Screenshot, IsTheStoredPicture) {
    Scene scene = *makeBuiltinScene(GetParam());
    if (isDark(scene))
        scene.environment = constantEnvironment(vec3(1.0F));  // as the program does that made the references
    const ExrPicture stored = readStored(GetParam());
    const Film reference = readReference(stored);
    RenderSettings settings;
    const auto bounces = std::find_if(stored.attributes.begin(), stored.attributes.end(),
                                      [](const auto& a) { return a.first == "licht.bounces"; });
    ASSERT_NE(bounces, stored.attributes.end());
    settings.bounces = static_cast<std::uint32_t>(std::stoul(bounces->second));
    settings.size = reference.size;
    settings.seed = 1;
    const Film film = renderFilm(scene, scene.cameras[0], settings, 256);
    expectSamePicture(film, reference, std::string("screenshot_") + GetParam());
}

// The test can fail: a picture that is one percent brighter is another picture.
TEST(ScreenshotTest, SeesASmallDifference) {
    const Film reference = readReference(readStored("cornell"));
    Film brighter = reference;
    for (float& value : brighter.mean.texels) value *= 1.01F;
    const Image brighter_color = colorOf(brighter);
    const Image color = colorOf(reference);
    EXPECT_FALSE(zTest({brighter_color, brighter.variance}, {color, reference.variance}).passed());
    EXPECT_TRUE(zTest({color, reference.variance}, {color, reference.variance}).passed());
}

INSTANTIATE_TEST_SUITE_P(Builtin, Screenshot, testing::Values("cornell", "furnace", "gallery", "empty"),
                         [](const auto& instance) { return std::string(instance.param); });

}  // namespace
}  // namespace licht
