// The built-in scenes: that they are sound, and that they are what they say.
#include "samples/scenes/builtin.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "licht/scene/effects.h"
#include "licht/scene/scene.h"
#include "licht/shared/effects.h"
#include "mesh_checks.h"
#include "samples/scenes/shapes.h"

namespace licht {
namespace {

std::size_t triangleCount(const Scene& scene) {
    std::size_t count = 0;
    for (const Instance& instance : scene.instances) count += scene.meshes[instance.mesh].triangles.size();
    return count;
}

// Every scene.

class Builtin : public testing::TestWithParam<std::string> {};

TEST_P(Builtin, Validates) {
    const auto scene = makeBuiltinScene(GetParam());
    ASSERT_TRUE(scene);
    EXPECT_EQ(scene->name, GetParam());
    EXPECT_NO_THROW(validateScene(*scene));
    EXPECT_TRUE(scene->notes.empty());
    EXPECT_FALSE(scene->cameras.empty());
}

TEST_P(Builtin, HasUnitNormalsThatAgreeWithTheWinding) {
    const auto scene = makeBuiltinScene(GetParam());
    ASSERT_TRUE(scene);
    for (const Mesh& mesh : scene->meshes) {
        SCOPED_TRACE(mesh.name);
        for (const vec3& normal : mesh.normals) {
            // Normalising rounds the squared length, its root and each component: together below four units
            // in the last place.
            ASSERT_NEAR(glm::length(dvec3(normal)), 1.0, 4.0 * kEpsilon);
        }
        for (const uvec3& triangle : mesh.triangles) {
            const dvec3 face = areaVector(mesh, triangle);
            ASSERT_GT(glm::length(face), 0.0);
            if (mesh.normals.empty()) continue;
            for (int k = 0; k < 3; ++k) ASSERT_GT(glm::dot(face, dvec3(mesh.normals[triangle[k]])), 0.0);
        }
    }
}

TEST_P(Builtin, IsTheSameEachTime) {
    const auto first = makeBuiltinScene(GetParam());
    const auto second = makeBuiltinScene(GetParam());
    ASSERT_TRUE(first && second);
    ASSERT_EQ(first->meshes.size(), second->meshes.size());
    for (std::size_t k = 0; k < first->meshes.size(); ++k)
        EXPECT_EQ(first->meshes[k].positions, second->meshes[k].positions);
    ASSERT_EQ(first->textures.size(), second->textures.size());
    for (std::size_t k = 0; k < first->textures.size(); ++k)
        EXPECT_EQ(first->textures[k].bytes, second->textures[k].bytes);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Builtin,
                         testing::Values("cornell", "furnace", "gallery", "terrain", "spheres", "lamps",
                                         "empty"),
                         [](const testing::TestParamInfo<std::string>& scene) { return scene.param; });

TEST(BuiltinTable, NamesEveryScene) {
    std::vector<std::string_view> names;
    for (const BuiltinScene& scene : builtinScenes()) {
        names.push_back(scene.name);
        EXPECT_FALSE(scene.meaning.empty());
    }
    std::sort(names.begin(), names.end());
    EXPECT_EQ(names, (std::vector<std::string_view>{"cornell", "empty", "furnace", "gallery", "lamps",
                                                    "meadow", "moving", "spheres", "terrain"}));
    EXPECT_FALSE(makeBuiltinScene("Cornell"));
    EXPECT_FALSE(makeBuiltinScene(""));
}

// Cornell.

class Cornell : public testing::Test {
protected:
    const Scene scene = makeBuiltinScene("cornell").value();
};

TEST_F(Cornell, HasTheMeasuredAreas) {
    // A coordinate below one metre is rounded by at most epsilon / 4, and an area of edges shorter than one
    // metre by the sum of a few of these.
    constexpr double kTolerance = 4.0 * kEpsilon;
    EXPECT_NEAR(area(meshNamed(scene, "light")), 0.130 * 0.105, kTolerance);
    EXPECT_NEAR(area(meshNamed(scene, "floor")), 0.5 * (0.5528 + 0.5496) * 0.5592, kTolerance);
    EXPECT_NEAR(area(meshNamed(scene, "ceiling")), 0.556 * 0.5592 - 0.130 * 0.105, kTolerance);
    EXPECT_NEAR(area(meshNamed(scene, "back wall")), 0.5 * (0.5496 + 0.556) * 0.5488, kTolerance);
    EXPECT_NEAR(area(meshNamed(scene, "right wall")), 0.5592 * 0.5488, kTolerance);
}

TEST_F(Cornell, HasBlocksOfTheMeasuredVolume) {
    // Base area by the shoelace formula over the corners in millimetres, times the height.
    const auto prism = [](const std::array<std::array<double, 2>, 4>& base, double height) {
        double twice = 0.0;
        for (std::size_t k = 0; k < 4; ++k)
            twice += base[k][1] * base[(k + 1) % 4][0] - base[k][0] * base[(k + 1) % 4][1];
        return 0.5 * twice * height * 1e-9;
    };
    // The missing bottom lies in y = 0 and adds nothing to the integral of x . n over the surface.
    constexpr double kTolerance = 4.0 * kEpsilon;
    EXPECT_NEAR(signedVolume(meshNamed(scene, "short block")),
                prism({{{130, 65}, {82, 225}, {240, 272}, {290, 114}}}, 165), kTolerance);
    EXPECT_NEAR(signedVolume(meshNamed(scene, "tall block")),
                prism({{{423, 247}, {265, 296}, {314, 456}, {472, 406}}}, 330), kTolerance);
}

TEST_F(Cornell, FacesInward) {
    const dvec3 middle{0.278, 0.2744, 0.2796};
    for (const char* name : {"floor", "ceiling", "back wall", "left wall", "right wall", "light"}) {
        const Mesh& wall = meshNamed(scene, name);
        for (const uvec3& triangle : wall.triangles) {
            EXPECT_GT(glm::dot(areaVector(wall, triangle), middle - corner(wall, triangle, 0)), 0.0) << name;
        }
    }
    for (const vec3& normal : meshNamed(scene, "light").normals) EXPECT_EQ(normal, vec3(0, -1, 0));
}

TEST_F(Cornell, ShowsRedAtTheLeftAndGreenAtTheRight) {
    ASSERT_EQ(scene.cameras.size(), 1U);
    const Camera& camera = scene.cameras[0];
    // The focal length is 35 mm, the film 25 mm high: tan(y_fov / 2) = 12.5 / 35. The tangent's slope here is
    // below 1.2.
    EXPECT_NEAR(std::tan(0.5 * static_cast<double>(camera.y_fov)), 12.5 / 35.0, 1.2 * kEpsilon);
    EXPECT_EQ(camera.aspect, 1.0F);
    EXPECT_EQ(vec3(camera.world_from_view[2]), vec3(0, 0, -1));
    EXPECT_NEAR(camera.world_from_view[3].x, 0.278F, 1e-6F);
    EXPECT_NEAR(camera.world_from_view[3].y, 0.273F, 1e-6F);
    EXPECT_NEAR(camera.world_from_view[3].z, -0.8F, 1e-6F);
    const mat4 view_from_world = glm::inverse(camera.world_from_view);
    const auto across = [&](const char* name) {
        return (view_from_world * vec4(meshNamed(scene, name).positions[0], 1.0F)).x;
    };
    EXPECT_LT(across("left wall"), 0.0F);
    EXPECT_GT(across("right wall"), 0.0F);
    const vec4 left = scene.materials[meshNamed(scene, "left wall").material].base_color;
    const vec4 right = scene.materials[meshNamed(scene, "right wall").material].base_color;
    EXPECT_GT(left.r, left.g);
    EXPECT_GT(right.g, right.r);
}

TEST_F(Cornell, IsLambertianWithOneLight) {
    std::size_t lights = 0;
    for (const Material& material : scene.materials) {
        EXPECT_EQ(material.metallic, 0.0F);
        EXPECT_EQ(material.specular, 0.0F);
        if (material.emission != vec3(0.0F)) ++lights;
    }
    EXPECT_EQ(lights, 1U);
    EXPECT_FALSE(scene.environment);
    EXPECT_TRUE(scene.lights.empty());
    const Effects effects = detectEffects(scene);
    EXPECT_FALSE(effects.has(kEffectGlossy));
    EXPECT_FALSE(effects.has(kEffectTextures));
    EXPECT_TRUE(effects.has(kEffectEmission));
}

// Furnace.

TEST(Furnace, IsClosedAndUniform) {
    const Scene scene = makeBuiltinScene("furnace").value();
    ASSERT_EQ(scene.materials.size(), 1U);
    const Material& material = scene.materials[0];
    EXPECT_EQ(vec3(material.base_color), vec3(0.5F));
    EXPECT_EQ(material.emission, vec3(0.5F));
    EXPECT_EQ(material.metallic, 0.0F);
    EXPECT_EQ(material.specular, 0.0F);
    EXPECT_FALSE(scene.environment);
    EXPECT_TRUE(scene.lights.empty());
    for (const Mesh& mesh : scene.meshes) {
        EXPECT_TRUE(isClosed(mesh)) << mesh.name;
        EXPECT_TRUE(mesh.normals.empty()) << mesh.name;
        if (mesh.name == "room") {
            EXPECT_EQ(signedVolume(mesh), -8.0);
        } else {
            EXPECT_GT(signedVolume(mesh), 0.0) << mesh.name;
        }
    }
}

TEST(Furnace, HoldsEverythingInsideTheRoom) {
    const Scene scene = makeBuiltinScene("furnace").value();
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        if (mesh.name == "room") continue;
        for (const vec3& position : mesh.positions) {
            const vec3 p(instance.world_from_object * vec4(position, 1.0F));
            ASSERT_LT(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}), 1.0F) << mesh.name;
        }
    }
    const vec3 eye(scene.cameras.at(0).world_from_view[3]);
    EXPECT_LT(std::max({std::abs(eye.x), std::abs(eye.y), std::abs(eye.z)}), 1.0F);
}

TEST(Empty, HasNothingButACamera) {
    const Scene scene = makeBuiltinScene("empty").value();
    EXPECT_EQ(triangleCount(scene), 0U);
    EXPECT_TRUE(isDark(scene));
    EXPECT_EQ(scene.cameras.size(), 1U);
}

// Gallery.

TEST(Gallery, CallsForItsEffects) {
    const Scene scene = makeBuiltinScene("gallery").value();
    const Effects effects = detectEffects(scene);
    for (const uint effect :
         {kEffectTextures, kEffectNormalMaps, kEffectAlpha, kEffectGlossy, kEffectEmission,
          kEffectLightTriangles, kEffectPunctualLights, kEffectEnvironment}) {
        EXPECT_TRUE(effects.has(effect)) << effectTable()[effect].name;
    }
    for (const uint effect : {kEffectVertexColors, kEffectExtraUvSets, kEffectUnlit}) {
        EXPECT_FALSE(effects.has(effect)) << effectTable()[effect].name << ": " << effects.evidence[effect];
    }
    const auto any = [&](auto&& holds) {
        return std::any_of(scene.materials.begin(), scene.materials.end(), holds);
    };
    EXPECT_TRUE(any([](const Material& m) { return m.metallic == 1.0F && m.roughness <= 0.25F; }));
    EXPECT_TRUE(any(
        [](const Material& m) { return m.metallic == 0.0F && m.specular > 0.0F && m.roughness <= 0.2F; }));
    EXPECT_TRUE(any([](const Material& m) { return m.slots[kSlotMetallicRoughness].present(); }));
    EXPECT_TRUE(any([](const Material& m) { return m.alpha_mode == AlphaMode::mask; }));
    EXPECT_GE(std::count_if(scene.materials.begin(), scene.materials.end(),
                            [](const Material& m) { return m.emission != vec3(0.0F); }),
              3);
}

TEST(Gallery, UsesEveryMaterialAndTexture) {
    const Scene scene = makeBuiltinScene("gallery").value();
    std::vector<bool> material_used(scene.materials.size());
    std::vector<bool> mesh_used(scene.meshes.size());
    std::vector<bool> texture_used(scene.textures.size());
    for (const Instance& instance : scene.instances) {
        mesh_used[instance.mesh] = true;
        material_used[scene.meshes[instance.mesh].material] = true;
    }
    for (const Material& m : scene.materials) {
        for (const TextureSlot& slot : m.slots)
            if (slot.present()) texture_used[slot.texture] = true;
    }
    for (std::size_t k = 0; k < material_used.size(); ++k)
        EXPECT_TRUE(material_used[k]) << scene.materials[k].name;
    for (std::size_t k = 0; k < mesh_used.size(); ++k) EXPECT_TRUE(mesh_used[k]) << scene.meshes[k].name;
    for (std::size_t k = 0; k < texture_used.size(); ++k)
        EXPECT_TRUE(texture_used[k]) << scene.textures[k].name;
}

TEST(Gallery, StaysWithinItsBudget) {
    const Scene scene = makeBuiltinScene("gallery").value();
    EXPECT_GE(triangleCount(scene), 20'000U);
    EXPECT_LE(triangleCount(scene), 80'000U);
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        if (scene.materials[mesh.material].emission != vec3(0.0F)) {
            EXPECT_LE(mesh.triangles.size(), 200U) << mesh.name;
        }
    }
    for (const Texture& texture : scene.textures)
        EXPECT_LE(std::max(texture.width, texture.height), 512U) << texture.name;
}

TEST(Gallery, MasksLeavesButNotAllOfThem) {
    const Scene scene = makeBuiltinScene("gallery").value();
    const auto leaf = std::find_if(scene.materials.begin(), scene.materials.end(),
                                   [](const Material& m) { return m.alpha_mode == AlphaMode::mask; });
    ASSERT_NE(leaf, scene.materials.end());
    const Texture& texture = scene.textures.at(leaf->slots[kSlotBaseColor].texture);
    std::size_t solid = 0;
    for (std::size_t k = 3; k < texture.bytes.size(); k += 4) solid += texture.bytes[k] > 127 ? 1U : 0U;
    const std::size_t texels = std::size_t{texture.width} * texture.height;
    EXPECT_GT(solid, texels / 4);
    EXPECT_LT(solid, texels * 9 / 10);
}

// The shapes they are made of.

TEST(Shapes, AreClosedAndLookOutward) {
    const std::vector<Mesh> solids{
        boxMesh("box", 0, vec3(-1.0F), vec3(1.0F, 2.0F, 3.0F)),
        roundedBoxMesh("rounded box", 0, vec3(1.0F, 0.7F, 0.4F), 0.15F, 4),
        roundedBoxMesh("box rounded as far as it goes", 0, vec3(1.0F, 0.7F, 0.4F), 0.2F, 4),
        sphereMesh("sphere", 0, 1.0F, 13, 7),
        icosphereMesh("icosahedron", 0, 0.7F, 0),
        icosphereMesh("icosphere", 0, 0.7F, 3),
        torusMesh("torus", 0, 1.0F, 0.3F, 17, 9),
        torusKnotMesh("torus knot", 0, TorusKnot{}, 128, 8),
        coneMesh("cylinder", 0, 0.5F, 0.5F, 1.0F, 11),
        coneMesh("cone", 0, 0.5F, 0.0F, 1.0F, 11),
        coneMesh("cone on its tip", 0, 0.0F, 0.5F, 1.0F, 11),
        latheMesh("vase", 0, smoothProfile({{0.0F, 0.0F}, {0.4F, 0.1F}, {0.2F, 0.6F}, {0.0F, 0.7F}}, 5), 12),
    };
    for (const Mesh& solid : solids) {
        EXPECT_TRUE(isClosed(solid)) << solid.name;
        EXPECT_GT(signedVolume(solid), 0.0) << solid.name;
        EXPECT_EQ(solid.uv_sets.at(0).size(), solid.positions.size()) << solid.name;
    }
}

TEST(Shapes, HaveTheAreaAndVolumeOfTheirForm) {
    constexpr double kPiD = std::numbers::pi;
    // A polygon of n sides in a circle has the area pi sin(x) / x with x = 2 pi / n, short by x^2 / 6. A
    // sphere of n segments and n / 2 rings is short by that in either direction and keeps more than 1 - x^2
    // of its volume; a torus of n by n likewise.
    constexpr std::uint32_t n = 128;
    const double x = 2.0 * kPiD / n;
    const double sphere = signedVolume(sphereMesh("sphere", 0, 1.0F, n, n / 2));
    EXPECT_LT(sphere, 4.0 / 3.0 * kPiD);
    EXPECT_GT(sphere, 4.0 / 3.0 * kPiD * (1.0 - x * x));
    const double torus = signedVolume(torusMesh("torus", 0, 1.0F, 0.25F, n, n));
    EXPECT_LT(torus, 2.0 * kPiD * kPiD * 0.25 * 0.25);
    EXPECT_GT(torus, 2.0 * kPiD * kPiD * 0.25 * 0.25 * (1.0 - x * x));
    const double prism = signedVolume(coneMesh("cylinder", 0, 0.5F, 0.5F, 2.0F, n));
    // Eight rounded coordinates of size one or below a triangle; the sum over the closed surface keeps the
    // relative error of one.
    EXPECT_NEAR(prism, 2.0 * 0.25 * kPiD * std::sin(x) / x, 16.0 * kEpsilon);
    // Steiner's formula for a box of sides a, b, c widened by r: abc + 2 r (ab + bc + ca) + pi r^2 (a + b +
    // c) + 4/3 pi r^3.
    const double a = 0.7;
    const double b = 0.4;
    const double c = 0.1;
    const double r = 0.15;
    const double round = a * b * c + 2.0 * r * (a * b + b * c + c * a) + kPiD * r * r * (a + b + c) +
                         4.0 / 3.0 * kPiD * r * r * r;
    const double box = signedVolume(roundedBoxMesh("rounded box", 0, vec3(1.0F, 0.7F, 0.4F), 0.15F, 16));
    EXPECT_LT(box, round);
    // Its edges have 32 chords a quarter turn, so that what was said of the sphere holds with x = pi / 64.
    EXPECT_GT(box, round * (1.0 - kPiD * kPiD / 4096.0));
}

TEST(Shapes, HaveEveryCornerOfAnIcosphereOnTheSphere) {
    for (const std::uint32_t halvings : {0U, 1U, 2U}) {
        const Mesh mesh = icosphereMesh("icosphere", 0, 0.3F, halvings);
        const std::size_t faces = std::size_t{20} << (2 * halvings);
        EXPECT_EQ(mesh.triangles.size(), faces);
        EXPECT_EQ(mesh.positions.size(), faces / 2 + 2);  // Euler: V = E - F + 2 with E = 3 F / 2
        // Normalising rounds three times (below), scaling once more.
        for (const vec3& p : mesh.positions) EXPECT_NEAR(glm::length(dvec3(p)), 0.3, 0.3 * 4.0 * kEpsilon);
    }
    // An icosahedron of circumradius R has the edge R / sin(2 pi / 5) and the volume 5 (3 + sqrt 5) / 12
    // edge^3.
    const double edge = 1.0 / std::sin(0.4 * std::numbers::pi);
    EXPECT_NEAR(signedVolume(icosphereMesh("icosahedron", 0, 1.0F, 0)),
                5.0 * (3.0 + std::sqrt(5.0)) / 12.0 * edge * edge * edge, 16.0 * kEpsilon);
}

TEST(Shapes, LeadASplineThroughItsPoints) {
    const std::vector<vec2> points{{0.0F, 0.0F}, {0.4F, 0.1F}, {0.2F, 0.6F}, {0.0F, 0.7F}};
    const std::vector<vec2> curve = smoothProfile(points, 5);
    ASSERT_EQ(curve.size(), 16U);
    for (std::size_t k = 0; k < points.size(); ++k) EXPECT_EQ(curve[5 * k], points[k]);
}

}  // namespace
}  // namespace licht
