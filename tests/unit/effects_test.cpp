#include "licht/scene/effects.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "licht/shared/effects.h"

namespace licht {
namespace {

/// One triangle of area one half whose material calls for nothing: no reflection at its surface.
Scene plainScene() {
    Scene scene;
    Material matte;
    matte.name = "Matte";
    matte.metallic = 0.0F;
    matte.specular = 0.0F;
    scene.materials.push_back(matte);
    Mesh mesh;
    mesh.name = "Tri";
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    scene.meshes.push_back(mesh);
    scene.instances.push_back({"Tri", 0, mat4(1.0F)});
    scene.textures.push_back({"t", 1, 1, 8, {255, 255, 255, 255}});
    return scene;
}

std::vector<std::string> effectsOf(const std::function<void(Scene&)>& change) {
    Scene scene = plainScene();
    change(scene);
    return detectEffects(scene).names();
}

using Names = std::vector<std::string>;
using Change = std::function<void(Scene&)>;

Material& material(Scene& scene) {
    return scene.materials[0];
}
TextureSlot textured(std::uint32_t uv_set = 0) {
    return {.texture = 0, .uv_set = uv_set};
}

TEST(EffectTable, ListsEveryEffectOnceUnderItsNumber) {
    std::set<std::string_view> names;
    for (uint id = 0; id < kEffectCount; ++id) {
        const EffectInfo& info = effectTable().at(id);
        EXPECT_EQ(info.id, id);
        EXPECT_TRUE(names.insert(info.name).second);
        EXPECT_FALSE(info.meaning.empty());
    }
    EXPECT_EQ(allEffects().names().size(), std::size_t{kEffectCount});
}

TEST(DetectEffects, NothingIsCalledForWithoutEvidence) {
    EXPECT_EQ(detectEffects(Scene{}).names(), Names{});
    EXPECT_EQ(effectsOf([](Scene&) {}), Names{});
    EXPECT_EQ(effectsOf([](Scene& s) {
                  s.materials.resize(2);
                  s.materials[1].emission = vec3(1);
                  s.materials[1].slots[kSlotBaseColor] = textured(1);
                  s.materials[1].unlit = true;
              }),
              Names{})
        << "a material that no instance uses";
    EXPECT_EQ(effectsOf([](Scene& s) {
                  s.instances.clear();
                  material(s).metallic = 1.0F;
              }),
              Names{});
}

TEST(DetectEffects, EachByItsEvidence) {
    const std::vector<std::pair<Names, Change>> cases{
        {{"textures"}, [](Scene& s) { material(s).slots[kSlotBaseColor] = textured(); }},
        {{},
         [](Scene& s) {
             material(s).slots[kSlotBaseColor] = textured();
             material(s).base_color = vec4(0, 0, 0, 1);
         }},
        {{}, [](Scene& s) { material(s).slots[kSlotEmissive] = textured(); }},
        {{}, [](Scene& s) { material(s).slots[kSlotMetallicRoughness] = textured(); }},
        {{}, [](Scene& s) { material(s).slots[kSlotSpecular] = textured(); }},
        {{"textures", "glossy"},
         [](Scene& s) {
             material(s).slots[kSlotSpecular] = textured();
             material(s).specular = 1.0F;
         }},
        {{"textures", "normalMaps"}, [](Scene& s) { material(s).slots[kSlotNormal] = textured(); }},
        {{},
         [](Scene& s) {
             material(s).slots[kSlotNormal] = textured();
             material(s).normal_scale = 0.0F;
         }},
        {{"textures", "extraUvSets"}, [](Scene& s) { material(s).slots[kSlotBaseColor] = textured(1); }},
        {{"vertexColors"},
         [](Scene& s) {
             s.meshes[0].colors = {vec4(1), vec4(1), vec4(1, 1, 0.5F, 1)};
         }},
        {{}, [](Scene& s) { s.meshes[0].colors.assign(3, vec4(1)); }},
        {{"alpha"},
         [](Scene& s) {
             material(s).alpha_mode = AlphaMode::blend;
             material(s).base_color.w = 0.5F;
         }},
        {{}, [](Scene& s) { material(s).alpha_mode = AlphaMode::blend; }},
        {{}, [](Scene& s) { material(s).alpha_mode = AlphaMode::mask; }},
        {{"alpha"},
         [](Scene& s) {
             material(s).alpha_mode = AlphaMode::mask;
             material(s).base_color.w = 0.25F;
         }},
        {{"vertexColors", "alpha"},
         [](Scene& s) {
             material(s).alpha_mode = AlphaMode::mask;
             s.meshes[0].colors.assign(3, vec4(1, 1, 1, 0));
         }},
        {{"glossy"}, [](Scene& s) { material(s).metallic = 0.01F; }},
        {{"glossy"}, [](Scene& s) { material(s).specular = 0.01F; }},
        {{"glossy"},
         [](Scene& s) {
             material(s).specular = 1.0F;
             material(s).ior = 0.0F;
         }},
        {{"glossy"},
         [](Scene& s) {  // still reflects at grazing angles
             material(s).specular = 1.0F;
             material(s).ior = 1.0F;
         }},
        {{"punctualLights"}, [](Scene& s) { s.lights.push_back({.name = "L"}); }},
        {{}, [](Scene& s) { s.lights.push_back({.name = "L", .intensity = vec3(0)}); }},
        {{"punctualLights", "suns"},
         [](Scene& s) {
             s.lights.push_back(
                 {.name = "L", .kind = PunctualLight::Kind::directional, .angular_diameter = 0.01F});
         }},
        {{},
         [](Scene& s) {
             s.lights.push_back({.name = "L",
                                 .kind = PunctualLight::Kind::directional,
                                 .intensity = vec3(0),
                                 .angular_diameter = 0.01F});
         }},
        {{"punctualLights"},
         [](Scene& s) {
             s.lights.push_back(
                 {.name = "L", .kind = PunctualLight::Kind::directional, .angular_diameter = 1e-9F});
         }},
        {{"punctualLights"}, [](Scene& s) { s.lights.push_back({.name = "L", .angular_diameter = 0.01F}); }},
        {{"environment"}, [](Scene& s) { s.environment = constantEnvironment(vec3(0, 0, 0.1F)); }},
        {{}, [](Scene& s) { s.environment = constantEnvironment(vec3(0)); }},
        {{"unlit"},
         [](Scene& s) {
             material(s).unlit = true;
             material(s).metallic = 1.0F;
             material(s).emission = vec3(1);
             material(s).slots[kSlotNormal] = textured();
         }},
    };
    for (std::size_t i = 0; i < cases.size(); ++i) {
        EXPECT_EQ(effectsOf(cases[i].second), cases[i].first) << "case " << i;
    }
}

/// The plain triangle beside an emitting one, scaled so that the latter has `share` of the area.
Scene lampScene(float share) {
    Scene scene = plainScene();
    scene.materials.resize(2, scene.materials[0]);
    scene.materials[1].emission = vec3(1);
    scene.meshes.push_back(scene.meshes[0]);
    scene.meshes[1].material = 1;
    scene.meshes[1].name = "Lamp";
    scene.instances.push_back({"Lamp", 1, glm::scale(mat4(1.0F), vec3(share / (1.0F - share), 1, 1))});
    return scene;
}

TEST(DetectEffects, LightTrianglesAreSampledWhileTheyAreTheSmallerPart) {
    EXPECT_EQ(detectEffects(lampScene(0.25F)).names(), (Names{"emission", "lightTriangles"}));
    EXPECT_EQ(detectEffects(lampScene(0.75F)).names(), (Names{"emission"}));
    EXPECT_EQ(effectsOf([](Scene& s) { material(s).emission = vec3(1); }), (Names{"emission"}))
        << "everything shines";
}

TEST(DetectEffects, AnEmissiveTextureCountsByItsMeanOverItsMaximum) {
    Scene scene = lampScene(0.75F);
    scene.materials[1].slots[kSlotEmissive] = textured();
    EXPECT_EQ(detectEffects(scene).names(), (Names{"textures", "emission"}))
        << "a white texture changes nothing";
    // One lit texel of four: 0.75 / 4 is less than half of the area.
    scene.textures[0] = {"t", 4, 1, 8, {255, 255, 255, 255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255}};
    EXPECT_EQ(detectEffects(scene).names(), (Names{"textures", "emission", "lightTriangles"}));
    scene.textures[0] = {"t", 1, 1, 8, {0, 0, 0, 255}};
    EXPECT_EQ(detectEffects(scene).names(), (Names{"textures"})) << "a black texture lights nothing";
}

TEST(DetectEffects, TheEvidenceNamesTheFirstObject) {
    Scene scene = lampScene(0.25F);
    material(scene).slots[kSlotBaseColor] = textured(2);
    scene.lights.push_back({.name = "L"});
    const Effects effects = detectEffects(scene);
    EXPECT_EQ(effects.evidence[kEffectTextures], "material 'Matte' has a base colour texture");
    EXPECT_EQ(effects.evidence[kEffectExtraUvSets],
              "material 'Matte' reads its base colour texture by TEXCOORD_2");
    EXPECT_EQ(effects.evidence[kEffectEmission], "material 'Matte' emits");
    EXPECT_EQ(effects.evidence[kEffectLightTriangles], "mesh 'Lamp' emits, and 25 % of all surface does");
    EXPECT_EQ(effects.evidence[kEffectPunctualLights], "light 'L' shines");
    EXPECT_EQ(effects.evidence[kEffectGlossy], "");
}

TEST(IsDark, WhereNothingGivesLight) {
    EXPECT_TRUE(isDark(Scene{}));
    EXPECT_TRUE(isDark(plainScene()));
    const std::vector<Change> lights{[](Scene& s) { material(s).emission = vec3(0, 1, 0); },
                                     [](Scene& s) { material(s).unlit = true; },  // nothing wants light
                                     [](Scene& s) { s.lights.push_back({.name = "L"}); },
                                     [](Scene& s) { s.environment = constantEnvironment(vec3(1)); }};
    for (const Change& light : lights) {
        Scene scene = plainScene();
        light(scene);
        EXPECT_FALSE(isDark(scene));
    }
    const std::vector<Change> none{[](Scene& s) { material(s).emission = vec3(0.5F * kDimmestEmission); },
                                   [](Scene& s) { s.lights.push_back({.name = "L", .intensity = vec3(0)}); },
                                   [](Scene& s) {
                                       material(s).emission = vec3(1);
                                       material(s).slots[kSlotEmissive] = textured();
                                       s.textures = {{"black", 1, 1, 8, {0, 0, 0, 255}}};
                                   },
                                   [](Scene& s) { s.environment = constantEnvironment(vec3(0)); }};
    for (const Change& change : none) {
        Scene scene = plainScene();
        change(scene);
        EXPECT_TRUE(isDark(scene));
    }
    // One unlit mark lights nothing.
    Scene marked = lampScene(0.25F);
    marked.materials[1].emission = vec3(0.0F);
    marked.materials[1].unlit = true;
    EXPECT_TRUE(isDark(marked));
}

}  // namespace
}  // namespace licht
