// KHR_materials_iridescence from the file to the list of effects.
#include <gtest/gtest.h>

#include "../support/gltf_file.h"
#include "licht/image/files.h"
#include "licht/scene/effects.h"
#include "licht/scene/gltf.h"
#include "licht/shared/effects.h"

namespace licht {
namespace {

using test::GltfFile;
using test::Json;
using test::TemporaryFolder;

class Iridescence : public testing::Test {
protected:
    /// A triangle whose material 'X' has that extension, and two textures.
    Scene load(const Json& extension, const Json& others = Json::object()) {
        GltfFile file = GltfFile::triangle();
        file.json["extensionsRequired"] = {"KHR_materials_iridescence"};
        // Of different sizes: equal images would be one texture.
        for (int i = 0; i < 2; ++i) {
            const std::string name = i == 0 ? "one.png" : "two.png";
            writePng(folder_.path() / name, Image(1 + i, 1, 3));
            file.add("images", {{"uri", name}});
            file.add("textures", {{"source", i}});
        }
        file.primitive()["attributes"]["TEXCOORD_0"] = file.vec2s({0, 0, 1, 0, 0, 1});
        Json extensions = others;
        extensions["KHR_materials_iridescence"] = extension;
        file.primitive()["material"] = file.add(
            "materials",
            {{"name", "X"}, {"pbrMetallicRoughness", {{"metallicFactor", 0}}}, {"extensions", extensions}});
        return loadGltf(file.writeGlb(folder_));
    }

    TemporaryFolder folder_;
};

TEST_F(Iridescence, DefaultsAreTheSpecifications) {
    const Scene scene = load(Json::object());
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(m.iridescence.factor, 0.0F);
    EXPECT_EQ(m.iridescence.ior, 1.3F);
    EXPECT_EQ(m.iridescence.thickness_minimum, 100.0F);
    EXPECT_EQ(m.iridescence.thickness_maximum, 400.0F);
    EXPECT_FALSE(m.slots[kSlotIridescence].present());
    EXPECT_FALSE(m.slots[kSlotIridescenceThickness].present());
    EXPECT_TRUE(scene.notes.empty() || scene.notes[0].text.find("iridescence") == std::string::npos);
}

TEST_F(Iridescence, EveryValueArrives) {
    const Scene scene = load({{"iridescenceFactor", 0.75},
                              {"iridescenceIor", 1.8},
                              {"iridescenceThicknessMinimum", 250},
                              {"iridescenceThicknessMaximum", 550},
                              {"iridescenceTexture", {{"index", 1}}},
                              {"iridescenceThicknessTexture", {{"index", 0}}}});
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(m.iridescence.factor, 0.75F);
    EXPECT_EQ(m.iridescence.ior, 1.8F);
    EXPECT_EQ(m.iridescence.thickness_minimum, 250.0F);
    EXPECT_EQ(m.iridescence.thickness_maximum, 550.0F);
    EXPECT_TRUE(m.slots[kSlotIridescence].present());
    EXPECT_TRUE(m.slots[kSlotIridescenceThickness].present());
    EXPECT_NE(m.slots[kSlotIridescence].texture, m.slots[kSlotIridescenceThickness].texture);
    const Effects effects = detectEffects(scene);
    EXPECT_EQ(effects.evidence[kEffectIridescence], "material 'X' is iridescent");
    EXPECT_EQ(effects.evidence[kEffectTextures], "material 'X' has a iridescence texture");
}

TEST_F(Iridescence, ValuesOutsideOfTheirRangeAreClampedAndNoted) {
    const Scene scene =
        load({{"iridescenceFactor", 2}, {"iridescenceIor", 0.5}, {"iridescenceThicknessMaximum", -1}});
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(m.iridescence.factor, 1.0F);
    EXPECT_EQ(m.iridescence.ior, 1.0F);
    EXPECT_EQ(m.iridescence.thickness_maximum, 0.0F);
    std::size_t noted = 0;
    for (const SceneNote& note : scene.notes)
        noted += note.text.find("iridescence") != std::string::npos ? 1U : 0U;
    EXPECT_EQ(noted, 3U);
    EXPECT_NO_THROW(validateScene(scene));
}

TEST_F(Iridescence, IsCalledForWhereAFilmCanShow) {
    const auto on = [this](const Json& extension, const Json& others = Json::object()) {
        return detectEffects(load(extension, others)).has(kEffectIridescence);
    };
    const Json texture{{"index", 0}};
    EXPECT_TRUE(on({{"iridescenceFactor", 0.1}}));
    EXPECT_FALSE(on({{"iridescenceFactor", 0}, {"iridescenceTexture", texture}}));
    EXPECT_FALSE(on({{"iridescenceFactor", 1}, {"iridescenceThicknessMaximum", 0}}));
    EXPECT_TRUE(on({{"iridescenceFactor", 1},
                    {"iridescenceThicknessMaximum", 0},
                    {"iridescenceThicknessTexture", texture}}));
    EXPECT_FALSE(on({{"iridescenceFactor", 1}}, {{"KHR_materials_unlit", Json::object()}}));
    // A film reflects on a base that does not.
    const Effects effects = detectEffects(
        load({{"iridescenceFactor", 1}}, {{"KHR_materials_specular", {{"specularFactor", 0}}}}));
    EXPECT_TRUE(effects.has(kEffectIridescence));
    EXPECT_TRUE(effects.has(kEffectGlossy));
}

}  // namespace
}  // namespace licht
