// Thin walls hold light back, what lies before the near plane is not drawn, sky is exactly the sky.
#include <gtest/gtest.h>

#include <iostream>

#include "licht/film/film.h"
#include "licht/settings/settings.h"
#include "pictures.h"

namespace licht {
namespace {

/// A dark room of 4 x 3 x 4 m whose walls are 1e-3 m thick, under a sky of 1e6. In `at`.
Scene thinRoom(const vec3& at) {
    Scene scene;
    scene.materials = {lambert(0.9F)};
    constexpr float kWall = 1e-3F;
    const vec3 half(2.0F, 1.5F, 2.0F);
    place(scene, boxMesh("outside", 0, at - half - kWall, at + half + kWall));
    Mesh inside = boxMesh("inside", 0, at - half, at + half);
    for (vec3& n : inside.normals) n = -n;
    for (uvec3& t : inside.triangles) std::swap(t.y, t.z);
    place(scene, std::move(inside));
    scene.environment = constantEnvironment(vec3(1e6F));
    return scene;
}

/// Largest value of a picture taken inside.
float leak(const vec3& at, std::uint32_t samples) {
    const Camera camera =
        lookingCamera("inside", at + vec3(1.5F, 1.0F, 1.5F), at + vec3(-2.0F, -1.5F, -2.0F), 1.6F);
    const Film film = renderFilm(thinRoom(at), camera, test::picture(48, 8), samples);
    float most = 0.0F;
    for (int c = 0; c < 3; ++c) most = std::max(most, test::largestOf(film.mean, c));
    return most;
}

TEST(Walls, OneMillimetreLetsNoLightThrough) {
    EXPECT_EQ(leak(vec3(0.0F), 16), 0.0F);
    EXPECT_EQ(leak(vec3(0.0F, 0.0F, 64.0F), 16), 0.0F);
    // Farther out an ulp is a share of the wall: at 4096 m half of one, and the offset is 32 units.
    for (const float far_out : {1024.0F, 4096.0F}) {
        std::cout << far_out << " m away: " << leak(vec3(far_out, 0.0F, 0.0F), 8) << " of 1e6\n";
    }
}

// A camera in a box that glows 3, inside a room that glows 5.
TEST(NearPlane, ClipsWhatIsBeforeItAndNothingElse) {
    for (const float half : {0.02F, 0.005F}) {
        Scene scene;
        scene.materials = {lambert(0.0F, 3.0F), lambert(0.0F, 5.0F)};
        for (Material& m : scene.materials) m.double_sided = true;
        place(scene, boxMesh("box", 0, vec3(-half), vec3(half)));
        place(scene, boxMesh("room", 1, vec3(-2), vec3(2)));
        Camera camera = lookingCamera("inside", vec3(0.0F), vec3(0, 0, -1), 0.8F);
        camera.z_near = 0.01F;
        const Film film = renderFilm(scene, camera, test::picture(32, 0), 2);
        // The box's front wall fills the picture; its side walls lie outside of the angle of view.
        const float expected = half > camera.z_near ? 3.0F : 5.0F;
        for (std::size_t i = 0; i < film.mean.texels.size(); i += 4) ASSERT_EQ(film.mean.texels[i], expected);
    }
}

// A black ball before a sky of 0.75: one sample is one or the other, and no layer holds a number that is
// none.
TEST(Sky, SilhouettesAreSkyOrSurface) {
    Scene scene;
    scene.materials = {lambert(0.0F)};
    place(scene, sphereMesh("ball", 0, 1.0F, 48, 24));
    scene.environment = constantEnvironment(vec3(0.75F));
    RenderSettings settings = test::picture(64, 2);
    settings.layers = {LayerId::albedo, LayerId::normal, LayerId::depth, LayerId::motion};
    const Film film =
        renderFilm(scene, lookingCamera("viewer", vec3(0, 0, 4), vec3(0.0F), 0.8F), settings, 1);
    int sky = 0;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const float value = film.mean.at(x, y, 0);
            const bool is_sky = !(film.layer(LayerId::depth).at(x, y, 0) < kInfinity);
            ASSERT_EQ(film.mean.at(x, y, 3), 1.0F);
            ASSERT_EQ(value, is_sky ? 0.75F : 0.0F);
            ASSERT_EQ(film.layer(LayerId::normal).at(x, y, 2) == 0.0F &&
                          film.layer(LayerId::normal).at(x, y, 0) == 0.0F,
                      is_sky);
            ASSERT_TRUE(std::isfinite(film.layer(LayerId::motion).at(x, y, 0)) &&
                        std::isfinite(film.layer(LayerId::motion).at(x, y, 1)));
            sky += is_sky ? 1 : 0;
        }
    }
    EXPECT_GT(sky, 500);
    EXPECT_LT(sky, 3'500);
}

// A mesh of no triangles, and one whose every triangle is a line: the picture is the sky, exactly.
TEST(Sky, MeshesWithoutSurfaceLeaveItAsItIs) {
    Scene scene;
    scene.materials = {lambert(0.5F)};
    Mesh none;
    none.name = "none";
    place(scene, none);
    Mesh lines = boxMesh("lines", 0, vec3(-1), vec3(1));
    for (uvec3& t : lines.triangles) t.z = t.y;
    place(scene, std::move(lines));
    scene.environment = constantEnvironment(vec3(0.25F, 0.5F, 4.0F));
    const Film film =
        renderFilm(scene, lookingCamera("viewer", vec3(0, 0, 4), vec3(0.0F), 0.8F), test::picture(16, 4), 2);
    for (std::size_t i = 0; i < film.mean.texels.size(); i += 4) {
        ASSERT_EQ(vec3(film.mean.texels[i], film.mean.texels[i + 1], film.mean.texels[i + 2]),
                  vec3(0.25F, 0.5F, 4.0F));
    }
}

}  // namespace
}  // namespace licht
