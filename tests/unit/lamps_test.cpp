// The hall of lamps: closed, lit by its lamps alone, which are what later stages may recognise them as.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "licht/scene/effects.h"
#include "licht/shared/effects.h"
#include "mesh_checks.h"
#include "samples/scenes/builtin.h"
#include "samples/scenes/shapes.h"

namespace licht {
namespace {

Scene lampsOf(std::uint64_t triangles = 0) {
    return makeBuiltinScene("lamps", triangles).value();
}

bool shines(const Scene& scene, const Mesh& mesh) {
    return scene.materials[mesh.material].emission != vec3(0.0F);
}

struct Lamp {
    const Mesh* mesh;
    const Material* material;
    mat4 world_from_object;
};

std::vector<Lamp> lampsIn(const Scene& scene) {
    std::vector<Lamp> lamps;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        if (shines(scene, mesh))
            lamps.push_back({&mesh, &scene.materials[mesh.material], instance.world_from_object});
    }
    return lamps;
}

/// Walls, ceiling and floor as one mesh.
Mesh roomOf(const Scene& scene) {
    Mesh room;
    for (const char* name : {"walls", "ceiling", "floor", "floor border"}) {
        Mesh part = meshNamed(scene, name);
        part.material = room.material;
        appendMesh(room, part);
    }
    return room;
}

/// The solid angle of all faces as seen from a point, over 4 pi: -1 inside a room that looks inward, 0
/// outside (van Oosterom and Strackee 1983, "The solid angle of a plane triangle").
double windingNumber(const Mesh& mesh, const dvec3& point) {
    double sum = 0.0;
    for (const uvec3& triangle : mesh.triangles) {
        std::array<dvec3, 3> to{};
        for (int k = 0; k < 3; ++k)
            to[static_cast<std::size_t>(k)] = glm::normalize(corner(mesh, triangle, k) - point);
        const auto& [a, b, c] = to;
        sum +=
            std::atan2(glm::dot(a, glm::cross(b, c)), 1.0 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a));
    }
    return 2.0 * sum / (4.0 * std::numbers::pi);
}

class LampsOfCount : public testing::TestWithParam<std::uint64_t> {};

TEST_P(LampsOfCount, HasAsManyShiningTriangles) {
    const Scene scene = lampsOf(GetParam());
    EXPECT_NO_THROW(validateScene(scene));
    std::size_t count = 0;
    for (const Lamp& lamp : lampsIn(scene)) {
        EXPECT_LE(lamp.mesh->triangles.size(), 80U);
        count += lamp.mesh->triangles.size();
    }
    EXPECT_EQ(count, GetParam());
}

// 1,234 and 2,999 end in the middle of a sphere; 60,000 triangles are more lamps than the longest hall wants.
INSTANTIATE_TEST_SUITE_P(Lamps, LampsOfCount, testing::Values(kFewestTriangles, 1'234, 2'999, 10'000, 60'000),
                         [](const auto& count) { return "Of" + std::to_string(count.param); });

class Lamps : public testing::Test {
protected:
    const Scene scene = lampsOf();
};

TEST_F(Lamps, AreAboutTwoHundredEachAMeshOfItsOwn) {
    const std::vector<Lamp> lamps = lampsIn(scene);
    EXPECT_GE(lamps.size(), 190U);
    EXPECT_LE(lamps.size(), 210U);
    const auto meshes = std::count_if(scene.meshes.begin(), scene.meshes.end(),
                                      [this](const Mesh& mesh) { return shines(scene, mesh); });
    EXPECT_EQ(static_cast<std::size_t>(meshes), lamps.size());
}

TEST_F(Lamps, AreTheOnlyLightOfAClosedRoom) {
    EXPECT_FALSE(scene.environment);
    EXPECT_TRUE(scene.lights.empty());
    const Mesh room = roomOf(scene);
    EXPECT_TRUE(isClosed(room));
    EXPECT_LT(signedVolume(room), 0.0);  // it looks inward
    // Sums of 10,000 angles, each good to a few roundings of a double.
    constexpr double kTolerance = 1e-9;
    EXPECT_NEAR(windingNumber(room, dvec3(scene.cameras.at(0).world_from_view[3])), -1.0, kTolerance);
    EXPECT_NEAR(windingNumber(room, dvec3(0.0, 20.0, -20.0)), 0.0, kTolerance);
    for (const Lamp& lamp : lampsIn(scene)) {
        const dvec3 place(lamp.world_from_object * vec4(lamp.mesh->positions.front(), 1.0F));
        EXPECT_NEAR(windingNumber(room, place), -1.0, kTolerance) << lamp.mesh->name;
    }
}

TEST_F(Lamps, OnlyEmitSomeToBothSides) {
    std::size_t both_sides = 0;
    const std::vector<Lamp> lamps = lampsIn(scene);
    for (const Lamp& lamp : lamps) {
        EXPECT_EQ(lamp.material->base_color, vec4(0, 0, 0, 1));
        EXPECT_EQ(lamp.material->specular, 0.0F);
        EXPECT_EQ(lamp.material->metallic, 0.0F);
        if (lamp.material->double_sided) ++both_sides;
    }
    EXPECT_GT(both_sides, lamps.size() / 10);
    EXPECT_LT(both_sides, lamps.size() / 2);
}

TEST_F(Lamps, HavePowersOfTwoOrdersOfMagnitude) {
    std::vector<double> powers;
    for (const Lamp& lamp : lampsIn(scene)) {
        const auto brightest = static_cast<double>(
            std::max({lamp.material->emission.r, lamp.material->emission.g, lamp.material->emission.b}));
        powers.push_back(area(*lamp.mesh) * brightest * (lamp.material->double_sided ? 2.0 : 1.0));
    }
    std::sort(powers.begin(), powers.end());
    EXPECT_GE(powers.back(), 100.0 * powers.front());
    // None rules: by power alone the strongest would be picked one time in twenty at most.
    double sum = 0.0;
    for (const double power : powers) sum += power;
    EXPECT_LT(powers.back(), 0.05 * sum);
}

TEST_F(Lamps, AreRectanglesSpheresAndShards) {
    std::size_t rectangles = 0;
    std::size_t spheres = 0;
    std::size_t shards = 0;
    for (const Lamp& lamp : lampsIn(scene)) {
        SCOPED_TRACE(lamp.mesh->name);
        const auto& positions = lamp.mesh->positions;
        if (lamp.mesh->triangles.size() == 2) {
            ++rectangles;
            ASSERT_EQ(positions.size(), 6U);
            const dvec3 a(positions[0]);
            const dvec3 b(positions[1]);
            const dvec3 c(positions[2]);
            const dvec3 d(positions[5]);
            // Coordinates below 64 m are rounded three times, by 2^-19 each at most.
            constexpr double kRounding = 4.0 * 0x1p-19;
            EXPECT_LT(glm::length(a + c - b - d), 4.0 * kRounding);
            EXPECT_LT(std::abs(glm::distance(a, c) - glm::distance(b, d)), 2.0 * kRounding);
        } else if (lamp.mesh->triangles.size() == 20 || lamp.mesh->triangles.size() == 80) {
            ++spheres;
            EXPECT_TRUE(isClosed(*lamp.mesh));
            const double radius = glm::length(dvec3(positions[0]));
            for (const vec3& p : positions)
                EXPECT_NEAR(glm::length(dvec3(p)), radius, 8.0 * kEpsilon * radius);
        } else {
            ++shards;
            EXPECT_TRUE(lamp.material->double_sided);
        }
    }
    for (const std::size_t count : {rectangles, spheres, shards}) EXPECT_GE(count, 30U);
}

TEST_F(Lamps, CallForNothingButGlossAndEmission) {
    const Effects effects = detectEffects(scene);
    EXPECT_TRUE(effects.has(kEffectGlossy));
    EXPECT_TRUE(effects.has(kEffectLightTriangles));
    for (const uint effect : {kEffectTextures, kEffectAlpha, kEffectPunctualLights, kEffectEnvironment})
        EXPECT_FALSE(effects.has(effect)) << effectTable()[effect].name;
}

}  // namespace
}  // namespace licht
