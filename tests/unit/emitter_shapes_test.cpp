// What is taken for a ball among meshes, and what shines as one.
#include "licht/scene/emitter_shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "samples/scenes/shapes.h"

namespace licht {
namespace {

Scene shining(Mesh mesh, const mat4& transform = mat4(1.0F)) {
    Scene scene;
    Material glow;
    glow.emission = vec3(2.0F);
    scene.materials = {glow};
    scene.meshes = {std::move(mesh)};
    scene.instances.push_back({"", 0, transform});
    return scene;
}

bool isRound(const Mesh& mesh, const mat4& transform = mat4(1.0F)) {
    const Scene scene = shining(mesh, transform);
    return roundEmitter(scene, scene.instances[0]).has_value();
}

mat4 scaled(const vec3& by) {
    return glm::scale(mat4(1.0F), by);
}

// The icosahedron's closed forms; its halves have no simple ones, but they are known to lie between it and
// the sphere.
TEST(Ball, OfAnIcosahedron) {
    const std::optional<Ball> ball = ballOf(icosphereMesh("", 0, 2.0F, 0), mat4(1.0F));
    ASSERT_TRUE(ball);
    // Positions are rounded to 2^-24 of 2.
    EXPECT_LT(glm::length(ball->centre), 1e-6F);
    EXPECT_NEAR(ball->radius, 2.0F, 1e-5F);
    EXPECT_GE(ball->radius, 2.0F);
    const double edge = 2.0 / std::sin(2.0 * std::numbers::pi / 5.0);
    EXPECT_NEAR(ball->inner, std::sqrt(3.0) / 12.0 * (3.0 + std::sqrt(5.0)) * edge, 1e-6);
    EXPECT_NEAR(ball->area, 5.0 * std::sqrt(3.0) * edge * edge, 1e-5);
}

TEST(Ball, IsTheRounderTheFiner) {
    double inner = 0.0;
    double area = 0.0;
    for (std::uint32_t halvings = 0; halvings < 4; ++halvings) {
        const std::optional<Ball> ball = ballOf(icosphereMesh("", 0, 1.0F, halvings), mat4(1.0F));
        ASSERT_TRUE(ball) << halvings;
        EXPECT_GT(ball->inner, inner);
        EXPECT_GT(ball->area, area);
        EXPECT_LT(ball->area, 4.0 * std::numbers::pi);
        inner = ball->inner;
        area = ball->area;
    }
    EXPECT_GT(inner, 0.99);
}

// Rotated, mirrored, scaled alike, and where sums lose bits.
TEST(Ball, GoesWithItsInstance) {
    const mat4 turned = glm::rotate(mat4(1.0F), 1.1F, glm::normalize(vec3(1, 2, 3)));
    const mat4 mirror = scaled(vec3(-1, 1, 1));
    for (const mat4& by : {turned, mirror, turned * mirror * scaled(vec3(1.5F))}) {
        const std::optional<Ball> ball =
            ballOf(icosphereMesh("", 0, 1.0F, 1), glm::translate(mat4(1.0F), vec3(300, -20, 7)) * by);
        ASSERT_TRUE(ball);
        // Positions are rounded to 2^-16 there.
        EXPECT_LT(glm::distance(ball->centre, vec3(300, -20, 7)), 0x1p-15F);
        EXPECT_NEAR(ball->radius, std::cbrt(std::abs(glm::determinant(glm::mat3(by)))), 0x1p-14);
    }
}

// Meridians meet in a seam whose sides have vertices of their own, and in poles.
TEST(Ball, MayHaveSeamsAndPoles) {
    EXPECT_TRUE(isRound(sphereMesh("", 0, 1.0F, 12, 6)));
    EXPECT_TRUE(isRound(sphereMesh("", 0, 1.0F, 5, 3))) << "its box is no cube around the centre";
    Mesh flat = sphereMesh("", 0, 1.0F, 16, 8);
    Mesh loose;  // three vertices a face, each off by a rounding or two
    for (const uvec3& t : flat.triangles) {
        const auto first = static_cast<std::uint32_t>(loose.positions.size());
        for (int k = 0; k < 3; ++k) {
            const auto off = static_cast<float>((first + static_cast<std::uint32_t>(k)) % 5) - 2.0F;
            loose.positions.push_back(flat.positions[t[k]] + off * 0x1p-24F);
        }
        loose.triangles.emplace_back(first, first + 1, first + 2);
    }
    EXPECT_TRUE(isRound(loose));
    const auto pole = static_cast<std::uint32_t>(flat.positions.size());
    flat.positions.insert(flat.positions.end(), {vec3(0, 1, 0), vec3(1e-8F, 1, 0), vec3(0, 1, 1e-8F)});
    flat.triangles.emplace_back(pole, pole + 1, pole + 2);
    flat.triangles.emplace_back(pole, pole, pole + 1);
    EXPECT_TRUE(isRound(flat)) << "faces without area";
}

TEST(Ball, IsClosedAndFacesOutwards) {
    const Mesh ball = icosphereMesh("", 0, 1.0F, 1);
    Mesh open = ball;
    open.triangles.pop_back();
    EXPECT_FALSE(ballOf(open, mat4(1.0F)));
    Mesh inside_out = ball;
    for (uvec3& t : inside_out.triangles) std::swap(t.y, t.z);
    EXPECT_FALSE(ballOf(inside_out, mat4(1.0F)));
    Mesh turned = ball;
    std::swap(turned.triangles[7].y, turned.triangles[7].z);
    EXPECT_FALSE(ballOf(turned, mat4(1.0F)));
    Mesh twice = ball;
    twice.triangles.push_back(twice.triangles[0]);
    EXPECT_FALSE(ballOf(twice, mat4(1.0F)));
}

// One vertex of an icosahedron pushed in: a shallow dent is a ball of a smaller inner radius, a deep one
// hides from the centre.
TEST(Ball, MayBeDentedALittle) {
    const auto dented = [](float depth) {
        Mesh mesh = icosphereMesh("", 0, 1.0F, 2);
        const vec3 at = mesh.positions[0];
        for (vec3& p : mesh.positions)
            if (glm::distance(p, at) < 1e-5F) p *= 1.0F - depth;
        return mesh;
    };
    EXPECT_TRUE(isRound(dented(0.05F)));
    EXPECT_FALSE(isRound(dented(0.4F)));
    EXPECT_FALSE(ballOf(dented(1.5F), mat4(1.0F)));
}

TEST(RoundEmitter, IsNearlyASphere) {
    EXPECT_TRUE(isRound(icosphereMesh("", 0, 1.0F, 0)));
    EXPECT_FALSE(isRound(boxMesh("", 0, vec3(-1.0F), vec3(1.0F))));
    EXPECT_FALSE(isRound(sphereMesh("", 0, 1.0F, 4, 2))) << "an octahedron";
    EXPECT_TRUE(isRound(icosphereMesh("", 0, 1.0F, 2), scaled({1, 1.2F, 1})));
    EXPECT_FALSE(isRound(icosphereMesh("", 0, 1.0F, 2), scaled({1, 1.7F, 1})));
    EXPECT_FALSE(isRound(icosphereMesh("", 0, 1.0F, 2), scaled({1, 1, 0})));
    EXPECT_FALSE(isRound(torusMesh("", 0, 1.0F, 0.3F, 16, 8)));
    EXPECT_FALSE(isRound(Mesh{}));
}

// What is seen of it must be one emission.
TEST(RoundEmitter, ShinesAlikeEverywhere) {
    const auto still = [](auto change) {
        Scene scene = shining(icosphereMesh("", 0, 1.0F, 1));
        change(scene.materials[0]);
        return roundEmitter(scene, scene.instances[0]).has_value();
    };
    EXPECT_TRUE(still([](Material& m) { m.double_sided = true; }));
    EXPECT_FALSE(still([](Material& m) { m.emission = vec3(0.0F); }));
    EXPECT_FALSE(still([](Material& m) { m.unlit = true; }));
    EXPECT_FALSE(still([](Material& m) { m.slots[kSlotEmissive].texture = 0; }));
    EXPECT_FALSE(still([](Material& m) { m.alpha_mode = AlphaMode::mask; }));
    EXPECT_FALSE(still([](Material& m) { m.alpha_mode = AlphaMode::blend; }));
}

TEST(RoundEmitter, IsNotMadeOfWhatIsNoPlace) {
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e30F}) {
        Mesh mesh = icosphereMesh("", 0, 1.0F, 0);
        mesh.positions[3].y = bad;
        EXPECT_FALSE(isRound(mesh)) << bad;
    }
    Mesh unused = icosphereMesh("", 0, 1.0F, 1);
    unused.positions.insert(unused.positions.end(), 9, vec3(std::numeric_limits<float>::quiet_NaN()));
    EXPECT_TRUE(isRound(unused)) << "vertices that no triangle has";
    Mesh point = icosphereMesh("", 0, 1.0F, 0);
    std::fill(point.positions.begin(), point.positions.end(), vec3(1, 2, 3));
    EXPECT_FALSE(isRound(point));
}

}  // namespace
}  // namespace licht
