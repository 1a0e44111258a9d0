// What the table of lights makes of a scene: which lights there are, how likely each is, and when a tree is
// worth it.
#include "licht/light/light_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "licht/light/light_tree.h"
#include "licht/scene/effects.h"
#include "licht/settings/settings.h"
#include "licht/shared/effects.h"
#include "licht/shared/light_views.h"

namespace licht {
namespace {

Material emitter(float emission) {
    Material m;
    m.emission = vec3(emission);
    return m;
}

void add(Scene& scene, std::vector<vec3> positions, std::vector<uvec3> triangles, std::uint32_t material,
         const mat4& transform = mat4(1.0F)) {
    Mesh mesh;
    mesh.positions = std::move(positions);
    mesh.triangles = std::move(triangles);
    mesh.material = material;
    scene.instances.push_back({"", static_cast<std::uint32_t>(scene.meshes.size()), transform});
    scene.meshes.push_back(std::move(mesh));
}

// Dark ground, so that what shines stays the lesser part of all surface, and quads above it.
Scene sceneOfQuads(int count) {
    Scene scene;
    scene.materials = {Material{}, emitter(3.0F)};
    add(scene, {{-50, -1, 50}, {50, -1, 50}, {50, -1, -50}}, {{0, 1, 2}}, 0);
    for (int i = 0; i < count; ++i)
        add(scene, {{0, 0, 0}, {2, 0, 0}, {2, 0, 1}, {0, 0, 1}}, {{0, 1, 2}, {0, 2, 3}}, 1,
            glm::translate(mat4(1.0F), vec3(3.0F * static_cast<float>(i), 0, 0)));
    return scene;
}

// Six meridians, cut by three circles of latitude.
Mesh roundMesh() {
    Mesh mesh;
    const auto at = [&](int column, int row) {
        const double turn = std::numbers::pi / 3.0 * column;
        const double height = 0.25 * std::numbers::pi * row;
        const double r = row == 0 || row == 4 ? 0.0 : std::sin(height);
        mesh.positions.emplace_back(r * std::cos(turn), -std::cos(height), r * std::sin(turn));
    };
    for (int column = 0; column < 6; ++column) {
        for (int row = 0; row < 4; ++row) {
            const auto first = static_cast<uint>(mesh.positions.size());
            at(column, row);
            at(column, row + 1);
            at((column + 1) % 6, row + 1);
            at((column + 1) % 6, row);
            if (row < 3) mesh.triangles.emplace_back(first, first + 1, first + 2);
            if (row > 0) mesh.triangles.emplace_back(first, first + 2, first + 3);
        }
    }
    return mesh;
}

LightTable tableOf(const Scene& scene, LightChoice choice) {
    return buildLightTable(scene, detectEffects(scene), {}, choice);
}

double sumOfPmf(const LightTable& table) {
    double sum = 0.0;
    for (const AliasRecord& column : table.alias) sum += static_cast<double>(column.pmf);
    return sum;
}

vec3 areaOf(const LightRecord& light) {
    const ShapeLight shape = unpackShape(light);
    return glm::cross(shape.edge_u, shape.edge_v);
}

// What is packed comes back, beside the words that every kind has.
TEST(LightViews, ComeBackFromTheirRecord) {
    LightRecord record{};
    record.kind = kLightRectangle | kLightUneven;
    record.pmf = 0.25F;
    record.trail = 7;
    const ShapeLight shape = unpackShape(packShape(record, {vec3(1), vec3(2), vec3(3), vec3(4)}));
    EXPECT_EQ(shape.corner, vec3(1));
    EXPECT_EQ(shape.edge_u, vec3(2));
    EXPECT_EQ(shape.edge_v, vec3(3));
    EXPECT_EQ(shape.emission, vec3(4));
    const SphereLight sphere = unpackSphere(packSphere(record, {vec3(1), 2.0F, vec3(3)}));
    EXPECT_EQ(sphere.centre, vec3(1));
    EXPECT_EQ(sphere.radius, 2.0F);
    EXPECT_EQ(sphere.emission, vec3(3));
    const SunLight sun = unpackSun(packSun(record, {vec3(1), vec3(2), 3.0F}));
    EXPECT_EQ(sun.direction, vec3(1));
    EXPECT_EQ(sun.illuminance, vec3(2));
    EXPECT_EQ(sun.sine2, 3.0F);
    const LightRecord packed = packSpot(record, {vec3(1), 2.0F, vec3(3), vec3(4), 5.0F, 6.0F});
    const SpotLight spot = unpackSpot(packed);
    EXPECT_EQ(spot.position, vec3(1));
    EXPECT_EQ(spot.range, 2.0F);
    EXPECT_EQ(spot.intensity, vec3(3));
    EXPECT_EQ(spot.axis, vec3(4));
    EXPECT_EQ(spot.scale, 5.0F);
    EXPECT_EQ(spot.offset, 6.0F);
    EXPECT_EQ(packed.kind, record.kind);
    EXPECT_EQ(packed.pmf, record.pmf);
    EXPECT_EQ(packed.trail, record.trail);
}

TEST(LightTable, TwoHalvesOfARectangleAreOneLight) {
    const LightTable table = tableOf(sceneOfQuads(1), LightChoice::tree);
    ASSERT_EQ(table.lights.size(), 2U);
    EXPECT_EQ(kindOf(table.lights[0]), kLightRectangle);
    EXPECT_EQ(glm::length(areaOf(table.lights[0])), 2.0F);
    EXPECT_EQ(std::memcmp(&table.lights[0], &table.lights[1], sizeof(LightRecord)), 0);
    EXPECT_EQ(table.alias.size(), 2U);
    EXPECT_EQ(table.alias[1].pmf, 0.0F) << "the second half is never picked";
}

TEST(LightTable, WhatIsNoRectangleStaysTriangles) {
    const mat4 shear(vec4(1, 0, 0, 0), vec4(0, 1, 0, 0), vec4(0.01F, 0, 1, 0), vec4(0, 0, 0, 1));
    Scene sheared = sceneOfQuads(1);
    sheared.instances[1].world_from_object = shear;
    Scene bent = sceneOfQuads(1);
    bent.meshes[1].positions[3].y = 0.001F;
    Scene turned = sceneOfQuads(1);
    std::swap(turned.meshes[1].triangles[1].y, turned.meshes[1].triangles[1].z);  // its back is up
    for (const Scene* scene : {&sheared, &bent, &turned})
        for (const LightRecord& light : tableOf(*scene, LightChoice::power).lights)
            EXPECT_EQ(kindOf(light), kLightTriangle);
}

// The side that shines is the one whose corners turn counter-clockwise, in a mirrored instance too.
TEST(LightTable, MirroredRectanglesShineToTheSameSide) {
    Scene scene = sceneOfQuads(1);
    scene.instances[1].world_from_object = glm::scale(mat4(1.0F), vec3(-1, 1, 1));
    const LightTable table = tableOf(scene, LightChoice::power);
    ASSERT_EQ(kindOf(table.lights[0]), kLightRectangle);
    EXPECT_LT(areaOf(table.lights[0]).y, 0.0F);
}

TEST(LightTable, ProbabilitiesSumToOne) {
    Scene scene = sceneOfQuads(30);
    scene.environment = constantEnvironment(vec3(1.0F));
    PunctualLight point;
    point.position = vec3(1, 2, 3);
    PunctualLight sun;
    sun.kind = PunctualLight::Kind::directional;
    scene.lights = {point, sun, point};
    for (const LightChoice choice : {LightChoice::tree, LightChoice::power, LightChoice::uniform})
        EXPECT_NEAR(sumOfPmf(tableOf(scene, choice)), 1.0, 1e-6);
    const LightTable tree = tableOf(scene, LightChoice::tree);
    EXPECT_EQ(tree.alias.size(), 3U) << "the tree, the sun, the sky";
    EXPECT_EQ(tree.tree_lights, 62U) << "all halves of rectangles, and the points";
    EXPECT_EQ(tree.lights.size(), 64U);
    EXPECT_EQ(tree.environment_light, 63U);
}

// Lights that fill an angle stand together behind those that do not. Where scattering alone finds them they
// are there and never picked.
TEST(LightTable, SunsStandTogetherAndArePickedOnlyWhereLightsAreSampled) {
    PunctualLight sharp;
    sharp.kind = PunctualLight::Kind::directional;
    sharp.intensity = vec3(1.0F);  // says which is which
    PunctualLight sun = sharp;
    sun.angular_diameter = 0.01F;
    sun.intensity = vec3(2.0F);
    PunctualLight spot;
    spot.kind = PunctualLight::Kind::spot;
    spot.angular_diameter = 0.01F;  // means nothing here
    PunctualLight speck = sharp;
    speck.angular_diameter = 0.5F * kSmallestAngularDiameter;
    for (const int quads : {0, 3}) {
        Scene scene = sceneOfQuads(quads);
        scene.lights = {sun, sharp, sun, spot, speck};
        scene.environment = constantEnvironment(vec3(1.0F));
        for (const bool sampled : {true, false}) {
            for (const LightChoice choice : {LightChoice::tree, LightChoice::power, LightChoice::uniform}) {
                const LightTable table =
                    buildLightTable(scene, detectEffects(scene), {sampled, sampled}, choice);
                ASSERT_EQ(table.suns, 2U);
                EXPECT_NEAR(sumOfPmf(table), 1.0, 1e-6);
                for (uint i = 0; i < table.lights.size(); ++i) {
                    const LightRecord& light = table.lights[i];
                    const bool is_sun = i >= table.first_sun && i < table.first_sun + table.suns;
                    EXPECT_EQ(kindOf(light) == kLightDirectional && unpackSun(light).illuminance.x == 2.0F,
                              is_sun);
                    if (kindOf(light) != kLightDirectional) continue;
                    EXPECT_EQ(unpackSun(light).sine2 > 0.0F, is_sun);
                    EXPECT_EQ(light.pmf > 0.0F, sampled || !is_sun);
                }
            }
        }
    }
    Scene alone;
    alone.lights = {sun};
    const LightTable found = buildLightTable(alone, detectEffects(alone), {false, false}, LightChoice::tree);
    EXPECT_TRUE(found.alias.empty());
    ASSERT_EQ(found.lights.size(), 1U);
    EXPECT_EQ(found.first_sun, 0U);
    EXPECT_EQ(found.suns, 1U);
}

// Effects on demand: nothing is picked by a tree where there is nothing to pick.
TEST(LightTable, OneLightHasNoTree) {
    EXPECT_TRUE(tableOf(sceneOfQuads(1), LightChoice::tree).tree.empty());
    EXPECT_FALSE(tableOf(sceneOfQuads(2), LightChoice::tree).tree.empty());
    EXPECT_TRUE(tableOf(sceneOfQuads(2), LightChoice::power).tree.empty());
}

// Zero area, zero power, a light that is dark in one channel: dropped, or kept, but never a division by zero.
TEST(LightTable, WhatGivesNoLightIsNeverPicked) {
    for (const LightChoice choice : {LightChoice::tree, LightChoice::power, LightChoice::uniform}) {
        Scene scene = sceneOfQuads(3);
        scene.materials.push_back(emitter(0.0F));
        add(scene, {{0, 5, 0}, {1, 5, 0}, {2, 5, 0}}, {{0, 1, 2}}, 1);  // no area
        add(scene, {{0, 6, 0}, {0, 6, 0}, {0, 6, 0}}, {{0, 1, 2}}, 1);  // a point
        add(scene, {{0, 7, 0}, {1, 7, 0}, {0, 7, 1}}, {{0, 1, 2}}, 2);  // black
        const LightTable table = tableOf(scene, choice);
        ASSERT_EQ(table.lights.size(), 8U);
        EXPECT_EQ(table.lights[6].pmf, 0.0F);
        EXPECT_EQ(table.lights[7].pmf, 0.0F);
        EXPECT_NEAR(sumOfPmf(table), 1.0, 1e-6);
        for (const LightChildRecord& child : table.tree)
            EXPECT_TRUE(std::isfinite(child.intensity) && std::isfinite(child.half_size.x));
    }
    Scene dark = sceneOfQuads(2);
    dark.materials[1] = emitter(0.0F);
    EXPECT_TRUE(tableOf(dark, LightChoice::tree).lights.empty());
}

// A round lamp is one light, whichever face is hit; it weighs what its faces weigh together, and a second
// side that only its inside sees counts for nothing.
TEST(LightTable, ARoundMeshIsOneLight) {
    Scene scene = sceneOfQuads(2);
    scene.materials.push_back(emitter(3.0F));
    scene.materials[2].double_sided = true;
    constexpr std::size_t kFaces = 36;
    for (const uint material : {1U, 2U}) {
        Mesh lamp = roundMesh();
        add(scene, lamp.positions, lamp.triangles, material,
            glm::translate(mat4(1.0F), vec3(0, 9, material)));
    }
    Effects effects = detectEffects(scene);
    ASSERT_TRUE(effects.has(kEffectLightSpheres));
    const auto tableOfChoice = [&](LightChoice choice) {
        return buildLightTable(scene, effects, {}, choice);
    };
    for (const LightChoice choice : {LightChoice::tree, LightChoice::power, LightChoice::uniform}) {
        const LightTable table = tableOfChoice(choice);
        ASSERT_EQ(table.lights.size(), 4 + 2 * kFaces);
        EXPECT_NEAR(sumOfPmf(table), 1.0, 1e-6);
        for (const std::size_t first : {std::size_t{4}, 4 + kFaces}) {
            const LightRecord& lamp = table.lights[first];
            EXPECT_EQ(kindOf(lamp), kLightSphere);
            EXPECT_FLOAT_EQ(unpackSphere(lamp).centre.y, 9.0F);
            EXPECT_NEAR(unpackSphere(lamp).radius, 1.0F, 1e-5F);
            EXPECT_GT(lamp.pmf, 0.0F);
            for (std::size_t k = 1; k < kFaces; ++k)
                EXPECT_EQ(std::memcmp(&table.lights[first + k], &lamp, sizeof(LightRecord)), 0);
        }
        EXPECT_EQ(table.lights[4].pmf, table.lights[4 + kFaces].pmf);
    }
    std::size_t leaves = 0;
    for (const LightChildRecord& child : tableOfChoice(LightChoice::tree).tree)
        leaves += child.intensity > 0.0F && (child.next & kLightLeaf) != 0 ? 1 : 0;
    EXPECT_EQ(leaves, 4U);
    const LightTable power = tableOfChoice(LightChoice::power);
    effects.on[kEffectLightSpheres] = false;
    const LightTable faces = tableOfChoice(LightChoice::power);
    double sum = 0.0;
    for (std::size_t k = 0; k < kFaces; ++k) {
        EXPECT_EQ(kindOf(faces.lights[4 + k]), kLightTriangle);
        sum += static_cast<double>(faces.lights[4 + k].pmf);
    }
    // The second lamp counts twice there: r = a / (2 q + 2 a) against a / (2 q + 3 a).
    const auto r = static_cast<double>(power.lights[4].pmf);
    EXPECT_NEAR(sum, r / (1.0 + r), 1e-6);
}

// The same scene in other units of length: flux grows by the square for every light, so that the picks are
// the same. The points and the sun share a kind.
TEST(LightTable, PicksDoNotDependOnTheUnitOfLength) {
    const auto tableInUnits = [](float scale) {
        Scene scene = sceneOfQuads(0);
        scene.instances[0].world_from_object = glm::scale(mat4(1.0F), vec3(0.02F * scale));
        PunctualLight point;
        point.position = vec3(scale);
        point.intensity = vec3(scale * scale);
        PunctualLight sun;
        sun.kind = PunctualLight::Kind::directional;
        sun.intensity = vec3(0.5F);
        scene.lights = {point, sun};
        return tableOf(scene, LightChoice::power);
    };
    const LightTable metres = tableInUnits(1.0F);
    const LightTable small = tableInUnits(1e-3F);
    ASSERT_EQ(metres.alias.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(small.alias[i].pmf, metres.alias[i].pmf, 1e-6F) << i;
    EXPECT_GT(metres.alias[1].pmf, 0.05F);
    EXPECT_LT(metres.alias[1].pmf, 0.95F);
}

TEST(LightTable, UniformMeansAlikeAndPowerMeansByFlux) {
    Scene scene = sceneOfQuads(2);
    scene.instances[2].world_from_object = glm::scale(mat4(1.0F), vec3(2.0F));
    const LightTable uniform = tableOf(scene, LightChoice::uniform);
    EXPECT_EQ(uniform.lights[0].pmf, uniform.lights[2].pmf);
    const LightTable power = tableOf(scene, LightChoice::power);
    EXPECT_FLOAT_EQ(4.0F * power.lights[0].pmf, power.lights[2].pmf);
}

}  // namespace
}  // namespace licht
