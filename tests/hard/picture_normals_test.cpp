// Transforms and normals that are hard: mirrored, flat, stretched, missing or wrong.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <limits>
#include <numbers>

#include "licht/film/film.h"
#include "licht/scene/gltf.h"
#include "licht/settings/settings.h"
#include "pictures.h"
#include "support/gltf_file.h"

namespace licht {
namespace {

Scene lit(Mesh mesh, const mat4& world_from_object = mat4(1.0F)) {
    Scene scene;
    scene.materials = {lambert(0.8F)};
    place(scene, std::move(mesh), world_from_object);
    scene.lights.push_back(test::sun(3.0F));
    scene.environment = constantEnvironment(vec3(0.5F));
    return scene;
}

Camera viewer() {
    return lookingCamera("viewer", vec3(1.5F, 2, 4), vec3(0.0F), 0.8F);
}

RenderSettings layered(std::uint32_t side, std::uint32_t bounces) {
    RenderSettings settings = test::picture(side, bounces);
    settings.layers.add(LayerId::normal);
    return settings;
}

/// The largest difference of two pictures, as a share of the brighter one's largest value.
float difference(const Film& a, const Film& b) {
    float most = 0.0F;
    for (std::size_t i = 0; i < a.mean.texels.size(); ++i)
        most = std::max(most, std::abs(a.mean.texels[i] - b.mean.texels[i]));
    return most / test::largestOf(b.mean, 0);
}

// A box is its own mirror image: fronts stay fronts, and what is lit stays lit. Corners come in another
// order, so points on its faces may differ by rounding, a few units of 2^-24 in what they reflect.
TEST(Mirrored, ASymmetricObjectGivesTheSamePicture) {
    const Mesh box = boxMesh("box", 0, vec3(-1), vec3(1));
    const Film expected = renderFilm(lit(box), viewer(), layered(64, 1), 4);
    for (int axis = 0; axis < 3; ++axis) {
        vec3 scale(1.0F);
        scale[axis] = -1.0F;
        const Film film = renderFilm(lit(box, glm::scale(mat4(1.0F), scale)), viewer(), layered(64, 1), 4);
        EXPECT_TRUE(test::identical(film.layer(LayerId::normal), expected.layer(LayerId::normal))) << axis;
        const float most = difference(film, expected);
        std::cout << "axis " << axis << ": largest difference " << most << '\n';
        EXPECT_LE(most, 32.0F * 0x1p-24F) << axis;
    }
}

// Scaled to nothing: no picture of it. (Files lose such nodes with a note: unit/gltf_test.)
TEST(Singular, AnObjectScaledToNothingIsNotThere) {
    const Mesh box = boxMesh("box", 0, vec3(-1), vec3(1));
    Scene scene = lit(box);
    const Film expected = renderFilm(scene, viewer(), layered(48, 2), 2);
    place(scene, boxMesh("none", 0, vec3(-3), vec3(3)), glm::scale(mat4(1.0F), vec3(0.0F)));
    place(scene, boxMesh("line", 0, vec3(-3), vec3(3)), glm::scale(mat4(1.0F), vec3(0, 1, 0)));
    EXPECT_TRUE(test::identical(renderFilm(scene, viewer(), layered(48, 2), 2).mean, expected.mean));
}

// The sphere x^2 + y^2 + z^2 = 1 stretched to semi-axes (a, b, c): its normal at p is (x/a^2, y/b^2, z/c^2).
// A facet of the mesh is as wide as its share of the circle; at vertices the normal is exact, so a finer mesh
// is nearer. Each pixel looks at one vertex through a picture narrower than an ulp of its facets.
TEST(Stretched, NormalsAreThoseOfTheEllipsoid) {
    const vec3 axes(0.3F, 1.0F, 4.0F);
    const Mesh sphere = sphereMesh("sphere", 0, 1.0F, 32, 16);
    const Scene scene = lit(sphere, glm::scale(mat4(1.0F), axes));
    float worst = 0.0F;
    int seen = 0;
    for (std::size_t v = 40; v < sphere.positions.size(); v += 97) {
        const vec3 n0 = sphere.normals[v];
        if (n0.y < 0.3F) continue;  // seen from above
        const glm::dvec3 exact = glm::normalize(glm::dvec3(n0) / glm::dvec3(axes));
        const vec3 at = sphere.positions[v] * axes;
        const Film film = renderFilm(scene, downCamera(at, 1e-7F, 3.0F), layered(2, 0), 1);
        for (int pixel = 0; pixel < 4; ++pixel) {
            const glm::dvec3 n(film.layer(LayerId::normal).at(pixel % 2, pixel / 2, 0),
                               film.layer(LayerId::normal).at(pixel % 2, pixel / 2, 1),
                               film.layer(LayerId::normal).at(pixel % 2, pixel / 2, 2));
            worst = std::max(worst, static_cast<float>(glm::length(glm::cross(glm::normalize(n), exact))));
            ++seen;
        }
    }
    std::cout << seen << " normals, largest angle " << worst << '\n';
    EXPECT_GT(seen, 8);
    EXPECT_LT(worst, 1e-5F);
}

// Normals of zero and of no number: the facets' own are used.
TEST(WrongNormals, GiveTheFlatPicture) {
    const test::TemporaryFolder folder;
    const auto load = [&](float value, bool with) {
        test::GltfFile file;
        const std::vector<float> positions{-1, -1, 0, 1, -1, 0, 0, 1, 0.5F};
        const int p = file.vec3s(positions);
        test::Json attributes{{"POSITION", p}};
        if (with) attributes["NORMAL"] = file.vec3s(std::vector<float>(9, value));
        file.mesh({{"attributes", attributes}});
        file.root({{"mesh", 0}});
        Scene scene = loadGltf(file.writeGlb(folder));
        scene.lights.push_back(test::sun(3.0F));
        scene.environment = constantEnvironment(vec3(0.5F));
        return scene;
    };
    const Camera camera = lookingCamera("viewer", vec3(0, 1, 4), vec3(0.0F), 0.8F);
    const Film expected = renderFilm(load(0.0F, false), camera, layered(32, 2), 4);
    for (const float value : {0.0F, std::numeric_limits<float>::quiet_NaN(), kInfinity}) {
        const Film film = renderFilm(load(value, true), camera, layered(32, 2), 4);
        EXPECT_TRUE(test::identical(film.mean, expected.mean)) << value;
    }
    // A denormal one is short, but it has a direction.
    EXPECT_TRUE(test::identical(renderFilm(load(1e-42F, true), camera, layered(32, 2), 4).mean,
                                renderFilm(load(1.0F, true), camera, layered(32, 2), 4).mean));
}

// A white plane under a sky of 1 with normals bent by up to 85 degrees: it never gives more than it gets.
// What scatters below its true face is absorbed, so it is darker the more they are bent.
TEST(BentNormals, NeverGiveMoreThanTheyGet) {
    for (const float degrees : {0.0F, 30.0F, 60.0F, 85.0F}) {
        Scene scene;
        scene.materials = {lambert(1.0F)};
        Mesh plane = quadMesh("plane", 0, vec3(-1, 0, 1), vec3(1, 0, 1), vec3(1, 0, -1), vec3(-1, 0, -1));
        const float angle = glm::radians(degrees);
        for (vec3& n : plane.normals) n = vec3(std::sin(angle), std::cos(angle), 0.0F);
        place(scene, std::move(plane));
        scene.environment = constantEnvironment(vec3(1.0F));
        RenderSettings settings = test::picture(32, 8);
        settings.direct = DirectLight::hemisphere;  // every sample is worth 0 or 1
        const Film film = renderFilm(scene, downCamera(vec3(0.0F), 0.5F, 2.0F), settings, 64);
        const PictureMean mean = pictureMean(film, 0);
        // Cosine-distributed directions around n stay above the face with probability (1 + cos) / 2.
        const double exact = 0.5 * (1.0 + std::cos(static_cast<double>(angle)));
        std::cout << degrees << " degrees: " << mean.mean << " of " << exact << '\n';
        EXPECT_LE(mean.mean, 1.0 + 1e-3);
        EXPECT_NEAR(mean.mean, exact, 4.5 * mean.standard_error + 1e-5);
    }
}

// The same of light that is sampled: a sun just below the true face, before the bent normal, gives nothing,
// and one above it the normal's cosine, but for a few roundings.
TEST(BentNormals, TakeNoLightFromBelowTheFace) {
    Scene scene;
    scene.materials = {lambert(1.0F)};
    Mesh plane = quadMesh("plane", 0, vec3(-1, 0, 1), vec3(1, 0, 1), vec3(1, 0, -1), vec3(-1, 0, -1));
    const double normal = glm::radians(30.0);  // above the plane
    for (vec3& n : plane.normals) n = vec3(std::cos(normal), std::sin(normal), 0.0);
    place(scene, std::move(plane));
    for (const double degrees : {1.0, -1.0, -50.0}) {
        const double sun = glm::radians(degrees);
        PunctualLight light;
        light.kind = PunctualLight::Kind::directional;
        light.direction = vec3(-std::cos(sun), -std::sin(sun), 0.0);
        light.intensity = vec3(static_cast<float>(std::numbers::pi));  // a surface facing it shows 1
        scene.lights = {light};
        const Film film = renderFilm(scene, downCamera(vec3(0.0F), 0.5F, 2.0F), test::picture(8, 1), 1);
        const double exact = degrees > 0.0 ? std::cos(sun - normal) : 0.0;
        for (int x = 0; x < 8; ++x)
            EXPECT_NEAR(film.mean.at(x, x, 0), exact, 32.0 * 0x1p-24 * exact) << degrees << " degrees";
    }
}

// Smooth normals on a coarse sphere under a distant light: where a facet turns away but its normals do not,
// the light is cut off; there is no terminator fix. The step that this makes is measured over lights a
// fraction of a facet apart and held to what the geometry explains.
TEST(ShadowTerminator, TheStepIsNoLargerThanTheFacet) {
    for (const std::uint32_t segments : {12U, 24U, 48U}) {
        Scene scene;
        scene.materials = {lambert(1.0F)};
        place(scene, sphereMesh("sphere", 0, 1.0F, segments, segments / 2));
        const double facet = 2.0 * std::numbers::pi / segments;
        double worst = 0.0;
        for (const double share : {0.1, 0.45}) {
            PunctualLight light;
            light.kind = PunctualLight::Kind::directional;
            const double turn = share * facet;
            light.direction = glm::normalize(vec3(-std::cos(turn), 0.0, std::sin(turn)));
            light.intensity = vec3(static_cast<float>(std::numbers::pi));  // a surface facing it shows 1
            scene.lights = {light};
            const Film film =
                renderFilm(scene, downCamera(vec3(0.0F), 0.98F, 3.0F), test::picture(128, 1), 1);
            for (int y = 32; y < 96; ++y) {
                for (int x = 32; x < 96; ++x) {
                    worst = std::max(worst, static_cast<double>(
                                                std::abs(film.mean.at(x, y, 0) - film.mean.at(x - 1, y, 0))));
                }
            }
        }
        std::cout << segments << " segments: largest step " << worst << ", sine of a facet's angle "
                  << std::sin(facet) << '\n';
        // A facet's normals lie within its angle of its own, and N.L rises by at most 1/55 a pixel here
        // (1 / 64 / cos 30 degrees).
        EXPECT_LE(worst, std::sin(facet) + 1.0 / 55.0);
    }
}

}  // namespace
}  // namespace licht
