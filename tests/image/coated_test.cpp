// Pictures of clearcoats and of mirrors against closed forms: what they mirror, what they pass of what shines
// below, and of which normal.
#include <gtest/gtest.h>

#include <cmath>

#include "licht/scene/effects.h"
#include "licht/shared/effects.h"
#include "samples/scenes/assembly.h"
#include "samples/scenes/shapes.h"
#include "support/render_test.h"

namespace licht {
namespace {

using dvec3 = glm::dvec3;

double fresnel(double cosine) {
    return 0.04 + 0.96 * std::pow(1.0 - cosine, 5.0);
}

Material coated(float factor, float emission = 0.0F) {
    Material m = lambert(0.0F, emission);
    m.clearcoat.factor = factor;
    return m;
}

/// The floor y = 0, tangents along X, in that material.
Scene floorOf(const Material& material) {
    Scene scene;
    scene.materials = {material};
    Mesh mesh = quadMesh("floor", 0, vec3(-9, 0, 9), vec3(9, 0, 9), vec3(9, 0, -9), vec3(-9, 0, -9));
    mesh.tangents.assign(mesh.positions.size(), vec4(1, 0, 0, 1));
    place(scene, std::move(mesh));
    return scene;
}

/// Sees a metre of the floor's middle from a direction in the plane of Y and Z, parallel rays.
Camera cameraAt(double cosine) {
    const vec3 back(0.0F, cosine, std::sqrt(1.0 - cosine * cosine));
    Camera camera;
    camera.kind = Camera::Kind::orthographic;
    camera.y_extent = 0.5F;
    const vec3 right(1, 0, 0);
    camera.world_from_view =
        mat4(vec4(right, 0), vec4(glm::cross(back, right), 0), vec4(back, 0), vec4(5.0F * back, 1));
    return camera;
}

RenderSettings settings(std::uint32_t bounces) {
    RenderSettings result;
    result.size = uvec2(24);
    result.bounces = bounces;
    result.layering = Layering::gltf;  // takes a coat for smooth towards what lies below
    return result;
}

TEST(Coated, EmissionIsWhatTheCoatPasses) {
    for (const double cosine : {1.0, 0.5, 0.2}) {
        const Film film = renderFilm(floorOf(coated(0.8F, 2.0F)), cameraAt(cosine), settings(0), 2);
        expectMean(film, 2.0 * (1.0 - 0.8 * fresnel(cosine)));
    }
}

/// A texel that stands for that normal, and the normal that it stands for.
Texture normalTexel(const vec3& normal, dvec3& stored) {
    Texture texture;
    texture.width = texture.height = 1;
    for (int c = 0; c < 3; ++c) {
        texture.bytes.push_back(static_cast<std::uint8_t>(std::lround(255.0F * (0.5F + 0.5F * normal[c]))));
        stored[c] = texture.bytes.back() / 255.0 * 2.0 - 1.0;
    }
    texture.bytes.push_back(255);
    stored = glm::normalize(stored);
    return texture;
}

/// What a smooth coat over black mirrors of a constant sky of 1 cd/m^2 in the direction of `cosine`.
void expectMirrored(const Material& material, const Texture& texture, double cosine, double expected) {
    Scene scene = floorOf(material);
    scene.textures = {texture};
    scene.environment = constantEnvironment(vec3(1.0F));
    const Film film = renderFilm(scene, cameraAt(cosine), settings(1), 64);
    const PictureMean mean = pictureMean(film, 0);
    // The lobe of width 1e-3 averages F over as many radians, and shadows as much.
    EXPECT_NEAR(mean.mean, expected, 4.5 * mean.standard_error + 4e-3 * expected);
}

TEST(Coated, OnlyItsOwnNormalMapTurnsTheCoat) {
    constexpr double kCosine = 0.3;
    dvec3 stored;
    // Tilted across the plane of incidence, so that what is mirrored stays above both normals.
    const Texture tilted = normalTexel(glm::normalize(vec3(0.5F, 0.0F, 1.0F)), stored);
    Material base = coated(1.0F);
    base.slots[kSlotNormal].texture = 0;
    expectMirrored(base, tilted, kCosine, fresnel(kCosine));
    Material own = coated(1.0F);
    own.slots[kSlotClearcoatNormal].texture = 0;
    const double turned = stored.z * kCosine - stored.y * std::sqrt(1.0 - kCosine * kCosine);
    expectMirrored(own, tilted, kCosine, fresnel(turned));
}

/// A grey floor under a coated lamp of 1 m^2, rough enough that every estimator finds everything.
Scene lampScene(const Material& lamp) {
    Scene scene;
    scene.materials = {lambert(0.5F), lamp};
    place(scene, quadMesh("floor", 0, vec3(-9, 0, 9), vec3(9, 0, 9), vec3(9, 0, -9), vec3(-9, 0, -9)));
    place(scene, quadMesh("lamp", 1, vec3(-0.5, 1, -0.5), vec3(0.5, 1, -0.5), vec3(0.5, 1, 0.5),
                          vec3(-0.5, 1, 0.5)));
    return scene;
}

/// By scattering, by sampling lights and by both.
void expectEveryEstimatorAgrees(const Scene& scene, const std::string& name) {
    ASSERT_TRUE(detectEffects(scene).has(kEffectLightTriangles));
    const Camera camera = downCamera(vec3(1.5F, 0.0F, 0.0F), 0.5F, 0.9F);
    RenderSettings by = settings(1);
    by.sampler = Sequence::random;
    by.direct = DirectLight::hemisphere;
    const Film scattering = renderFilm(scene, camera, by, 1024);
    for (const DirectLight direct : {DirectLight::area, DirectLight::mis}) {
        by.direct = direct;
        by.seed = 7;
        expectSamePicture(renderFilm(scene, camera, by, 256), scattering, name);
    }
}

TEST(Coated, EveryEstimatorFindsTheSameLamp) {
    expectEveryEstimatorAgrees(lampScene(coated(1.0F, 4.0F)), "coated_lamp");
}

Material whiteMetal(float roughness) {
    Material m = lambert(1.0F);
    m.metallic = 1.0F;
    m.roughness = roughness;
    m.slots[kSlotNormal].texture = 0;
    return m;
}

// Far tilted: mirror images of most directions are below the floor.
const vec3 kTilts[]{{0.9F, 0.0F, 0.44F}, {0.0F, 0.9F, 0.44F}, {0.0F, -0.9F, 0.44F}, {-0.6F, 0.6F, 0.53F}};

// A mirror shows a sky of one wherever its normal map points. Bent normals mirror to a sine of 0.01 above the
// floor at least: below it are half vectors tilted by more than t = 0.005, of which the lobe of width a =
// 1e-3 has (1 - t / sqrt(t^2 + a^2)) / 2 = 0.0097.
TEST(MappedMirror, ShowsTheSkyUnderEveryTilt) {
    dvec3 stored;
    for (const vec3& tilt : kTilts)
        for (const double cosine : {0.95, 0.6, 0.3, 0.1}) {
            Scene scene = floorOf(whiteMetal(0.0F));
            scene.textures = {normalTexel(tilt, stored)};
            scene.environment = constantEnvironment(vec3(1.0F));
            const PictureMean mean = pictureMean(renderFilm(scene, cameraAt(cosine), settings(1), 64), 0);
            const double noise = 4.5 * mean.standard_error + 1e-5;
            EXPECT_LE(mean.mean, 1.0 + noise) << tilt.x << " " << tilt.y << ", cosine " << cosine;
            EXPECT_GE(mean.mean, 1.0 - 0.0097 - noise) << tilt.x << " " << tilt.y << ", cosine " << cosine;
        }
}

TEST(MappedMirror, EveryEstimatorFindsTheSameLamp) {
    dvec3 stored;
    Scene scene = lampScene(lambert(0.0F, 4.0F));
    Scene mapped = floorOf(whiteMetal(0.5F));
    scene.materials[0] = mapped.materials[0];
    scene.meshes[0].tangents = mapped.meshes[0].tangents;
    scene.textures = {normalTexel(kTilts[3], stored)};
    expectEveryEstimatorAgrees(scene, "mapped_mirror");
}

Scene coatedScene() {
    Material lamp = coated(0.5F, 4.0F);
    Scene scene = lampScene(lamp);
    scene.materials[0].clearcoat = {0.8F, 0.4F, 1.0F, 0.0F};
    return scene;
}

TEST(Coated, SpecialisedProgramsGiveTheSamePicture) {
    const Scene scene = coatedScene();
    const Camera camera = downCamera(vec3(1.5F, 0.0F, 0.0F), 0.5F, 0.9F);
    RenderSettings everything = settings(3);
    everything.all_effects = true;
    const Film a = renderFilm(scene, camera, settings(3), 16);
    const Film b = renderFilm(scene, camera, everything, 16);
    std::size_t different = 0;
    for (std::size_t i = 0; i < a.mean.texels.size(); ++i)
        different +=
            std::abs(a.mean.texels[i] - b.mean.texels[i]) > 1e-5F * std::abs(b.mean.texels[i]) ? 1U : 0U;
    EXPECT_LE(static_cast<double>(different), 0.01 * static_cast<double>(a.mean.texels.size()));
}

TEST(Coated, WithoutAShareNothingChanges) {
    Scene bare = coatedScene();
    for (Material& m : bare.materials) m.clearcoat = Material{}.clearcoat;
    Scene none = coatedScene();
    for (Material& m : none.materials) m.clearcoat.factor = 0.0F;
    const Camera camera = downCamera(vec3(1.5F, 0.0F, 0.0F), 0.5F, 0.9F);
    EXPECT_EQ(renderFilm(bare, camera, settings(2), 2).mean.texels,
              renderFilm(none, camera, settings(2), 2).mean.texels);
}

}  // namespace
}  // namespace licht
