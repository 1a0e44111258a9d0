// KHR_materials_clearcoat from the file to the list of effects.
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

class Clearcoat : public testing::Test {
protected:
    /// A matte triangle whose material 'X' has that extension and those others, and three textures.
    Scene load(const Json& extension, Json others = Json::object()) {
        GltfFile file = GltfFile::triangle();
        file.json["extensionsRequired"] = {"KHR_materials_clearcoat"};
        writePng(folder_.path() / "black.png", Image(1, 1, 3));
        for (int i = 0; i < 3; ++i) {
            file.add("images", {{"uri", "black.png"}});
            file.add("textures", {{"source", i}});
        }
        file.primitive()["attributes"]["TEXCOORD_0"] = file.vec2s({0, 0, 1, 0, 0, 1});
        others["KHR_materials_clearcoat"] = extension;
        others["KHR_materials_specular"] = {{"specularFactor", 0}};
        file.primitive()["material"] = file.add(
            "materials",
            {{"name", "X"}, {"pbrMetallicRoughness", {{"metallicFactor", 0}}}, {"extensions", others}});
        return loadGltf(file.writeGlb(folder_));
    }

    TemporaryFolder folder_;
};

TEST_F(Clearcoat, DefaultsAreTheSpecifications) {
    const Scene scene = load(Json::object());
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(m.clearcoat.factor, 0.0F);
    EXPECT_EQ(m.clearcoat.roughness, 0.0F);
    EXPECT_EQ(m.clearcoat.normal_scale, 1.0F);
    EXPECT_FALSE(m.slots[kSlotClearcoat].present());
    EXPECT_TRUE(scene.notes.empty());
    EXPECT_EQ(detectEffects(scene).names(), std::vector<std::string>{});
}

TEST_F(Clearcoat, EveryValueArrives) {
    const Scene scene = load({{"clearcoatFactor", 0.75},
                              {"clearcoatRoughnessFactor", 0.5},
                              {"clearcoatTexture", {{"index", 2}}},
                              {"clearcoatRoughnessTexture", {{"index", 1}}},
                              {"clearcoatNormalTexture", {{"index", 0}, {"scale", -0.25}}}});
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(m.clearcoat.factor, 0.75F);
    EXPECT_EQ(m.clearcoat.roughness, 0.5F);
    EXPECT_EQ(m.clearcoat.normal_scale, -0.25F);
    for (const uint slot : {kSlotClearcoat, kSlotClearcoatRoughness, kSlotClearcoatNormal})
        EXPECT_TRUE(m.slots.at(slot).present());
    EXPECT_EQ(scene.meshes.at(0).tangents.size(), 3U) << "derived for its normal map";
    const Effects effects = detectEffects(scene);
    EXPECT_EQ(effects.names(), (std::vector<std::string>{"textures", "normalMaps", "glossy", "clearcoat"}));
    EXPECT_EQ(effects.evidence[kEffectClearcoat], "material 'X' has a clearcoat");
    EXPECT_FALSE(m.emitsEvenly());
}

TEST_F(Clearcoat, ValuesOutsideOfTheirRangeAreClampedAndNoted) {
    const Scene scene = load({{"clearcoatFactor", 2}, {"clearcoatRoughnessFactor", -1}});
    EXPECT_EQ(scene.materials.at(0).clearcoat.factor, 1.0F);
    EXPECT_EQ(scene.materials.at(0).clearcoat.roughness, 0.0F);
    EXPECT_EQ(scene.notes.size(), 2U);
    Scene broken = scene;
    EXPECT_NO_THROW(validateScene(broken));
    broken.materials[0].clearcoat.roughness = 1.5F;
    EXPECT_ANY_THROW(validateScene(broken));
}

TEST_F(Clearcoat, IsCalledForWhereItShows) {
    const auto effects = [this](const Json& extension, const Json& others = Json::object()) {
        return detectEffects(load(extension, others));
    };
    const Json texture{{"index", 0}};
    EXPECT_TRUE(effects({{"clearcoatFactor", 0.1}}).has(kEffectClearcoat));
    EXPECT_TRUE(effects({{"clearcoatFactor", 0.1}}).has(kEffectGlossy))
        << "over a base that reflects nothing";
    const Effects off = effects({{"clearcoatRoughnessFactor", 1}, {"clearcoatNormalTexture", texture}});
    EXPECT_EQ(off.names(), std::vector<std::string>{});
    EXPECT_FALSE(
        effects({{"clearcoatFactor", 1}}, {{"KHR_materials_unlit", Json::object()}}).has(kEffectClearcoat));
    EXPECT_FALSE(effects({{"clearcoatFactor", 1}, {"clearcoatNormalTexture", {{"index", 0}, {"scale", 0}}}})
                     .has(kEffectNormalMaps));
}

}  // namespace
}  // namespace licht
