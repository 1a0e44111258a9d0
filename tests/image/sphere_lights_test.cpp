// Round meshes as lights: one mean, which is known in closed form, by every way of finding them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <string>
#include <vector>

#include "licht/film/film.h"
#include "licht/scene/effects.h"
#include "licht/scene/emitter_shapes.h"
#include "licht/settings/settings.h"
#include "licht/shared/effects.h"
#include "samples/scenes/assembly.h"
#include "samples/scenes/shapes.h"
#include "support/render_test.h"

namespace licht {
namespace {

using glm::dvec3;

constexpr double kPi = std::numbers::pi;
constexpr float kAlbedo = 0.5F;

// Faces up, around the origin; ground far below keeps what shines the lesser part of all surface.
Scene receiverScene(float half, float emission, float ground) {
    Scene scene;
    scene.materials = {lambert(kAlbedo), lambert(0.0F, emission)};
    place(scene, quadMesh("receiver", 0, vec3(-half, 0, half), vec3(half, 0, half), vec3(half, 0, -half),
                          vec3(-half, 0, -half)));
    const float g = ground;
    place(scene, quadMesh("ground", 0, vec3(-g, -g, g), vec3(g, -g, g), vec3(g, -g, -g), vec3(-g, -g, -g)));
    return scene;
}

// Lambert 1760: what a polygon of unit radiance gives to the upper side of the plane y = 0 at the origin is
// half the sum over its edges of the angle that an edge fills times the height of its plane's normal. What
// lies below the horizon is cut off. Corners relative to the origin.
double irradianceOf(const std::vector<dvec3>& polygon) {
    std::vector<dvec3> above;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const dvec3& a = polygon[i];
        const dvec3& b = polygon[(i + 1) % polygon.size()];
        if (a.y > 0.0) above.push_back(a);
        if ((a.y > 0.0) != (b.y > 0.0)) above.push_back(a + a.y / (a.y - b.y) * (b - a));
    }
    double sum = 0.0;
    for (std::size_t i = 0; i < above.size(); ++i) {
        const dvec3& a = above[i];
        const dvec3& b = above[(i + 1) % above.size()];
        const dvec3 normal = glm::cross(a, b);
        const double length = glm::length(normal);
        if (length > 0.0) sum += std::atan2(length, glm::dot(a, b)) * normal.y / length;
    }
    return 0.5 * std::abs(sum);
}

// Of the faces of a convex mesh that look at the origin.
double irradianceOf(const Mesh& mesh, const mat4& transform) {
    double sum = 0.0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const Corners c = worldCorners(mesh, transform, i);
        const std::vector<dvec3> p{dvec3(c[0]), dvec3(c[1]), dvec3(c[2])};
        if (glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), p[0]) < 0.0) sum += irradianceOf(p);
    }
    return sum;
}

RenderSettings settingsOf(DirectLight direct) {
    RenderSettings settings;
    settings.size = uvec2(48);
    settings.bounces = 1;
    settings.direct = direct;
    settings.sampler = Sequence::random;
    return settings;
}

constexpr DirectLight kEveryWay[] = {DirectLight::mis, DirectLight::area, DirectLight::hemisphere};

// Turned so that a face of the icosahedron, and of what its halving makes of it, looks along -X.
mat4 facingMinusX(const Mesh& mesh, const vec3& centre) {
    const Corners c = worldCorners(mesh, mat4(1.0F), 0);
    const vec3 n = glm::normalize(glm::cross(c[1] - c[0], c[2] - c[0]));
    const vec3 axis = glm::cross(n, vec3(-1, 0, 0));
    const float angle = std::atan2(glm::length(axis), -n.x);
    return glm::rotate(glm::translate(mat4(1.0F), centre), angle, glm::normalize(axis));
}

struct Lamp {
    const char* name;
    float radius;
    std::uint32_t halvings;
    vec3 centre;
    bool scattering_finds_it;
};

class Lamps : public testing::TestWithParam<Lamp> {};

// The receiver is a thousandth of its distance wide, so that what it gets differs from what its middle gets
// by the square of that.
TEST_P(Lamps, GiveTheFormFactorOfTheirFaces) {
    const Lamp lamp = GetParam();
    const Mesh mesh = icosphereMesh("lamp", 1, lamp.radius, lamp.halvings);
    const mat4 at = facingMinusX(mesh, lamp.centre);
    const double unit = irradianceOf(mesh, at);
    const auto emission = static_cast<float>(1.0 / unit);
    const float inner = 0.75F * lamp.radius;
    const float half = 1e-3F * std::min(glm::length(lamp.centre) - inner, 1.0F);
    Scene scene = receiverScene(half, emission, 5.0F * std::max(lamp.radius, 1.0F));
    place(scene, mesh, at);
    ASSERT_TRUE(detectEffects(scene).has(kEffectLightSpheres));
    const Camera camera = downCamera(vec3(0.0F), half, 100.0F * half);
    for (const DirectLight direct : kEveryWay) {
        if (direct == DirectLight::hemisphere && !lamp.scattering_finds_it) continue;
        SCOPED_TRACE(static_cast<int>(direct));
        expectMean(renderFilm(scene, camera, settingsOf(direct), 64),
                   static_cast<double>(kAlbedo) / kPi * unit * static_cast<double>(emission));
    }
}

INSTANTIATE_TEST_SUITE_P(
    Sphere, Lamps,
    testing::Values(Lamp{"icosahedron", 0.4F, 0, {0.9F, 1.1F, 0.2F}, true},
                    Lamp{"finer", 0.4F, 2, {0.9F, 1.1F, 0.2F}, true},
                    Lamp{"halfBelowTheHorizon", 0.4F, 1, {0.8F, 0.1F, 0.0F}, true},
                    Lamp{"touchingOutside", 0.5F, 1, {0.5004F, 0.0F, 0.0F}, true},
                    Lamp{"insideTheSphereBeforeAFace", 0.5F, 0, {0.45F, 0.0F, 0.0F}, true},
                    Lamp{"tiny", 1e-4F, 1, {0.6F, 0.8F, 0.0F}, false},
                    Lamp{"huge", 1000.0F, 2, {800.0F, 650.0F, 0.0F}, true}),
    [](const auto& instance) { return std::string(instance.param.name); });

// A closed room that shines: every place in it gets pi L.
TEST(InsideADoubleSidedSphere, EveryDirectionShines) {
    Scene scene = receiverScene(0.01F, 2.0F, 100.0F);
    scene.materials[1].double_sided = true;
    place(scene, icosphereMesh("room", 1, 1.0F, 1), glm::translate(mat4(1.0F), vec3(0.1F, 0.2F, 0.0F)));
    ASSERT_TRUE(detectEffects(scene).has(kEffectLightSpheres));
    for (const DirectLight direct : kEveryWay)
        expectMean(renderFilm(scene, downCamera(vec3(0.0F), 0.01F, 0.5F), settingsOf(direct), 4),
                   static_cast<double>(kAlbedo) * 2.0);
}

// One lamp before the other, a shining and two dark panes between, one of which cuts through a lamp, and a
// lamp with a dent; half of the dark panes is not there if asked for.
Scene crowd(bool half_there) {
    Scene scene = receiverScene(0.5F, 4.0F, 10.0F);
    scene.materials.push_back(lambert(0.3F));
    scene.materials[2].double_sided = true;
    if (half_there) {
        scene.materials[2].alpha_mode = AlphaMode::blend;
        scene.materials[2].base_color.w = 0.5F;
    }
    place(scene, icosphereMesh("near", 1, 0.2F, 0), glm::translate(mat4(1.0F), vec3(0.2F, 0.8F, 0.1F)));
    place(scene, icosphereMesh("far", 1, 0.6F, 1), glm::translate(mat4(1.0F), vec3(0.3F, 2.0F, 0.2F)));
    Mesh dented = icosphereMesh("dented", 1, 0.3F, 1);
    const vec3 at = dented.positions[0];
    for (vec3& p : dented.positions)
        if (glm::distance(p, at) < 1e-5F) p *= 0.85F;
    place(scene, dented,
          glm::scale(glm::translate(mat4(1.0F), vec3(-0.8F, 0.6F, 0.0F)), vec3(1.0F, -1.1F, 1.0F)));
    place(scene, quadMesh("shining pane", 1, vec3(0.1F, 1.2F, -0.3F), vec3(0.4F, 1.2F, -0.3F),
                          vec3(0.4F, 1.2F, 0.3F), vec3(0.1F, 1.2F, 0.3F)));
    place(scene, quadMesh("cutting pane", 2, vec3(-0.1F, 0.75F, -0.3F), vec3(0.5F, 0.9F, -0.3F),
                          vec3(0.5F, 0.9F, 0.3F), vec3(-0.1F, 0.75F, 0.3F)));
    place(scene, quadMesh("dark pane", 2, vec3(-0.1F, 0.4F, -0.3F), vec3(0.15F, 0.4F, -0.3F),
                          vec3(0.15F, 0.4F, 0.3F), vec3(-0.1F, 0.4F, 0.3F)));
    return scene;
}

class Crowds : public testing::TestWithParam<bool> {};

TEST_P(Crowds, EveryWayGivesTheSamePicture) {
    const Scene scene = crowd(GetParam());
    const Camera camera = downCamera(vec3(0.0F), 0.5F, 0.3F);
    RenderSettings settings = settingsOf(DirectLight::hemisphere);
    settings.bounces = 2;
    const Film reference = renderFilm(scene, camera, settings, 256);
    const auto expectTheSame = [&](DirectLight direct, LightChoice lights) {
        settings.direct = direct;
        settings.lights = lights;
        ++settings.seed;
        const Film film = renderFilm(scene, camera, settings, 64);
        const PictureMean a = pictureMean(film, 0), b = pictureMean(reference, 0);
        EXPECT_LE(std::abs(a.mean - b.mean),
                  4.5 * std::hypot(a.standard_error, b.standard_error) + 1e-5 * b.mean);
        expectSamePicture(film, reference, "crowd_of_lamps");
    };
    expectTheSame(DirectLight::mis, LightChoice::tree);
    expectTheSame(DirectLight::area, LightChoice::uniform);
}

TEST_P(Crowds, QueuesGiveTheSameBits) {
    const Scene scene = crowd(GetParam());
    RenderSettings settings = settingsOf(DirectLight::mis);
    settings.bounces = 4;
    const Camera camera = downCamera(vec3(0.0F), 0.5F, 0.3F);
    const Film one_kernel = renderFilm(scene, camera, settings, 4);
    settings.queues = true;
    for (const std::uint32_t rays_per_thread : {3U, 1U}) {
        settings.rays_per_thread = rays_per_thread;
        EXPECT_EQ(one_kernel.mean.texels, renderFilm(scene, camera, settings, 4).mean.texels);
    }
}

INSTANTIATE_TEST_SUITE_P(Sphere, Crowds, testing::Bool(),
                         [](const auto& instance) { return instance.param ? "alpha" : "opaque"; });

}  // namespace
}  // namespace licht
