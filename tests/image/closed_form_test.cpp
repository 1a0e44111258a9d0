// Pictures whose every value is known in closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "licht/film/film.h"
#include "licht/settings/settings.h"
#include "samples/scenes/assembly.h"
#include "samples/scenes/builtin.h"
#include "samples/scenes/shapes.h"
#include "support/render_test.h"

namespace licht {
namespace {

constexpr float kHalf = 0.5F;

// A square of side one in the plane y = height around the origin, facing up or down.
Mesh horizontalSquare(std::uint32_t material, float height, bool up, float half = kHalf) {
    const vec3 a(-half, height, half), b(half, height, half), c(half, height, -half), d(-half, height, -half);
    return up ? quadMesh("square", material, a, b, c, d) : quadMesh("square", material, d, c, b, a);
}

RenderSettings square(std::uint32_t side, std::uint32_t bounces, DirectLight direct = DirectLight::mis) {
    RenderSettings settings;
    settings.size = uvec2(side);
    settings.bounces = bounces;
    settings.direct = direct;
    return settings;
}

// The picture is exactly the receiving square, so its mean is albedo * Le * F. Howell, A Catalog of Radiation
// Heat Transfer Configuration Factors.
class FormFactor : public testing::TestWithParam<DirectLight> {};

TEST_P(FormFactor, ParallelUnitSquares) {
    Scene scene;
    scene.materials = {lambert(0.5F), lambert(0.0F, 4.0F)};
    place(scene, horizontalSquare(0, 0.0F, true));
    place(scene, horizontalSquare(1, 1.0F, false));  // seen from behind by the camera, which does not draw it
    // Below the receiver, so that the emitters' share of all surface stays small and they are worth sampling.
    place(scene, horizontalSquare(0, -5.0F, true, 4.0F));
    const Film film = renderFilm(scene, downCamera(vec3(0.0F), kHalf, 3.0F), square(64, 1, GetParam()), 256);
    expectMean(film, 0.5 * 4.0 * 0.1998248957);
}

TEST_P(FormFactor, PerpendicularUnitSquaresWithACommonEdge) {
    Scene scene;
    scene.materials = {lambert(0.5F), lambert(0.0F, 4.0F)};
    place(scene, horizontalSquare(0, 0.0F, true));
    place(scene, quadMesh("wall", 1, vec3(-kHalf, 0, kHalf), vec3(-kHalf, 0, -kHalf), vec3(-kHalf, 1, -kHalf),
                          vec3(-kHalf, 1, kHalf)));
    place(scene, horizontalSquare(0, -5.0F, true, 4.0F));
    const Film film = renderFilm(scene, downCamera(vec3(0.0F), kHalf, 3.0F), square(64, 1, GetParam()), 512);
    expectMean(film, 0.5 * 4.0 * 0.2000437761);
}

INSTANTIATE_TEST_SUITE_P(BothForms, FormFactor, testing::Values(DirectLight::mis, DirectLight::hemisphere),
                         [](const auto& instance) {
                             return instance.param == DirectLight::mis ? "mis" : "hemisphere";
                         });

// A convex Lambertian body under a uniform sky L shows albedo * L everywhere.
TEST(Sky, ConvexBodyUnderAUniformSky) {
    Scene scene;
    scene.materials = {lambert(0.75F)};
    Mesh sphere = sphereMesh("sphere", 0, 1.0F, 32, 16);
    sphere.normals.clear();
    place(scene, std::move(sphere));
    scene.environment = constantEnvironment(vec3(2.0F));
    // The picture lies well inside the sphere's outline.
    const Camera camera = downCamera(vec3(0.0F), 0.6F, 3.0F);
    const Film exact = renderFilm(scene, camera, square(32, 8, DirectLight::hemisphere), 4);
    for (std::size_t i = 0; i < exact.mean.texels.size(); i += 4)
        ASSERT_NEAR(exact.mean.texels[i], 1.5F, 1.5e-5F);
    expectMean(renderFilm(scene, camera, square(32, 8), 64), 1.5);
}

TEST(Sky, IsSeenAsItIs) {
    Scene scene = *makeBuiltinScene("empty");
    scene.environment = constantEnvironment(vec3(0.25F, 0.5F, 4.0F));
    const Film film = renderFilm(scene, scene.cameras[0], square(16, 8), 2);
    for (std::size_t i = 0; i < film.mean.texels.size(); i += 4) {
        // One multiplication each by bilinear weights that sum to one.
        ASSERT_FLOAT_EQ(film.mean.texels[i], 0.25F);
        ASSERT_FLOAT_EQ(film.mean.texels[i + 1], 0.5F);
        ASSERT_FLOAT_EQ(film.mean.texels[i + 2], 4.0F);
        ASSERT_EQ(film.mean.texels[i + 3], 1.0F);
    }
}

TEST(Empty, NoLightIsBlackAndTransparent) {
    const Scene scene = *makeBuiltinScene("empty");
    const Film film = renderFilm(scene, scene.cameras[0], square(16, 8), 2);
    for (const float value : film.mean.texels) ASSERT_EQ(value, 0.0F);
}

// Bowl: the inside of a sphere's cap with area share F of the sphere, under a uniform sky: r (1-F) / (1-rF) L
// after all bounces, the same at every point.
TEST(Sky, HalfSphereBowl) {
    Scene scene;
    scene.materials = {lambert(0.5F)};
    scene.materials[0].double_sided = true;
    // Lower half of an inward-facing sphere. Its facets are chords, so their area share of the polyhedron
    // rules; with 128 x 64 facets the difference is below 4e-4 of the result, which the tolerance contains as
    // a stated model error.
    Mesh bowl = sphereMesh("bowl", 0, 1.0F, 128, 64);
    bowl.normals.clear();
    std::erase_if(bowl.triangles, [&bowl](const uvec3& t) {
        return (bowl.positions[t.x] + bowl.positions[t.y] + bowl.positions[t.z]).y > 0.0F;
    });
    place(scene, std::move(bowl));
    scene.environment = constantEnvironment(vec3(1.0F));
    const Film film = renderFilm(scene, downCamera(vec3(0.0F), 0.3F, 3.0F), square(48, 40), 64);
    const double exact = 0.5 * 0.5 / (1.0 - 0.25);
    const PictureMean picture = pictureMean(film, 1);
    EXPECT_NEAR(picture.mean, exact, 4.5 * picture.standard_error + 4e-4 * exact);
}

// Radiance of a patch under a point light I at height d: albedo / pi * I / d^2. The patch is d / 1000 wide,
// so that the cosine and the distance vary by less than 1e-6 over it.
TEST(PunctualLight, InverseSquareFromMillimetresToAThousandKilometres) {
    for (const float d : {1e-3F, 1e-2F, 1.0F, 1e2F, 1e4F, 1e6F}) {
        Scene scene;
        scene.materials = {lambert(0.5F)};
        place(scene, horizontalSquare(0, 0.0F, true, d));
        PunctualLight light;
        light.intensity = vec3(2.0F * d * d);
        light.position = vec3(0, d, 0);
        scene.lights.push_back(light);
        const Film film = renderFilm(scene, downCamera(vec3(0.0F), 0.0005F * d, 2.0F * d), square(8, 1), 4);
        const double exact = 0.5 / std::numbers::pi * 2.0;
        // 1e-6 of geometry and a dozen fp32 roundings.
        for (std::size_t i = 0; i < film.mean.texels.size(); i += 4)
            ASSERT_NEAR(static_cast<double>(film.mean.texels[i]), exact, 2e-6 * exact) << "distance " << d;
    }
}

TEST(PunctualLight, DirectionalLightIsLux) {
    Scene scene;
    scene.materials = {lambert(0.5F)};
    place(scene, horizontalSquare(0, 0.0F, true, 2.0F));
    PunctualLight light;
    light.kind = PunctualLight::Kind::directional;
    light.intensity = vec3(3.0F);
    light.direction = glm::normalize(vec3(0, -1, 1));
    scene.lights.push_back(light);
    const Film film = renderFilm(scene, downCamera(vec3(0.0F), 0.5F, 2.0F), square(8, 1), 2);
    const double exact = 0.5 / std::numbers::pi * 3.0 * std::sqrt(0.5);
    for (std::size_t i = 0; i < film.mean.texels.size(); i += 4)
        ASSERT_NEAR(static_cast<double>(film.mean.texels[i]), exact, 2e-6 * exact);
}

// A spot of equal cones is full inside and dark outside; half way between two cones the squared ramp of
// KHR_lights_punctual is 1/4.
TEST(PunctualLight, SpotCone) {
    Scene scene;
    scene.materials = {lambert(1.0F)};
    place(scene, horizontalSquare(0, 0.0F, true, 4.0F));
    PunctualLight light;
    light.kind = PunctualLight::Kind::spot;
    light.intensity = vec3(static_cast<float>(std::numbers::pi));
    light.position = vec3(0, 1, 0);
    light.direction = vec3(0, -1, 0);
    light.inner_cone = 0.2F;
    light.outer_cone = 0.6F;
    scene.lights.push_back(light);
    const auto at = [&](float x) {
        const Film film = renderFilm(scene, downCamera(vec3(x, 0, 0), 0.0005F, 2.0F), square(2, 1), 1);
        return static_cast<double>(film.mean.at(0, 0, 0));
    };
    EXPECT_NEAR(at(0.0F), 1.0, 4e-6);
    EXPECT_EQ(at(std::tan(0.61F)), 0.0);
    const double middle = 0.5 * (std::cos(0.2) + std::cos(0.6));
    // cos^3 of the angle: inverse square and cosine. The patch is 1e-3 wide and the ramp changes by 2 * slope
    // * 5e-4 over half of it.
    EXPECT_NEAR(at(static_cast<float>(std::tan(std::acos(middle)))), 0.25 * std::pow(middle, 3), 2e-3);
}

// A partly transparent sheet over a black background lets the share 1 - alpha of the emitter through.
TEST(Alpha, BlendIsCoverage) {
    Scene scene;
    Material sheet = lambert(0.0F, 0.0F);
    sheet.alpha_mode = AlphaMode::blend;
    sheet.base_color.w = 0.3F;
    scene.materials = {lambert(0.0F, 2.0F), sheet};
    place(scene, horizontalSquare(0, 0.0F, true, 2.0F));
    place(scene, horizontalSquare(1, 0.5F, true, 2.0F));
    expectMean(renderFilm(scene, downCamera(vec3(0.0F), 0.5F, 2.0F), square(32, 0), 64), 2.0 * 0.7);
}

// The same for rays: the floor under the sheet sees the sky through it. Floor albedo 1, sky 1: light passes
// the sheet on its way down, and the camera's ray does.
TEST(Alpha, BlendLetsShadowRaysThrough) {
    Scene scene;
    Material sheet = lambert(0.0F);
    sheet.alpha_mode = AlphaMode::blend;
    sheet.base_color.w = 0.4F;
    scene.materials = {lambert(1.0F), sheet};
    place(scene, horizontalSquare(0, 0.0F, true, 2.0F));
    place(scene, horizontalSquare(1, 0.01F, true, 100.0F));  // nothing gets past its rim
    PunctualLight light;
    light.kind = PunctualLight::Kind::directional;
    light.intensity = vec3(static_cast<float>(std::numbers::pi));
    light.direction = vec3(0, -1, 0);
    scene.lights.push_back(light);
    expectMean(renderFilm(scene, downCamera(vec3(0.0F), 0.5F, 2.0F), square(32, 1), 128), 0.6 * 0.6);
}

TEST(Alpha, MaskIsAllOrNothing) {
    for (const float alpha : {0.49F, 0.5F}) {
        Scene scene;
        Material sheet = lambert(0.0F, 1.0F);
        sheet.alpha_mode = AlphaMode::mask;
        sheet.base_color.w = alpha;
        scene.materials = {lambert(0.0F, 2.0F), sheet};
        place(scene, horizontalSquare(0, 0.0F, true, 2.0F));
        place(scene, horizontalSquare(1, 0.5F, true, 2.0F));
        const Film film = renderFilm(scene, downCamera(vec3(0.0F), 0.5F, 2.0F), square(8, 0), 2);
        for (std::size_t i = 0; i < film.mean.texels.size(); i += 4)
            ASSERT_EQ(film.mean.texels[i], alpha < 0.5F ? 2.0F : 1.0F);
    }
}

}  // namespace
}  // namespace licht
