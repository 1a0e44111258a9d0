// A hundred thousand plants of a few kinds: what a scene of instances looks like.
#include <algorithm>
#include <array>
#include <cmath>

#include "samples/scenes/assembly.h"
#include "samples/scenes/builtin_scenes.h"
#include "samples/scenes/pattern.h"
#include "samples/scenes/shapes.h"

namespace licht {
namespace {

constexpr std::uint32_t kSide = 316;  // tufts along each side: about 100,000
constexpr float kSpacing = 0.16F;     // metres between them
constexpr std::uint32_t kTuftBlades = 14;
constexpr std::uint32_t kBladeRows = 3;     // of two triangles each
constexpr std::uint32_t kFlowerEvery = 23;  // tufts
constexpr std::uint32_t kPeriod = 1U << 12U;
const vec3 kSun = glm::normalize(vec3(-0.55F, 0.38F, -0.74F));

/// Low hills; level in front of the camera.
float heightAt(const vec2& p) {
    const float wide = valueNoise(p / 13.0F + vec2(100.0F), uvec2(kPeriod), 3);
    const float narrow = valueNoise(p / 3.5F + vec2(200.0F), uvec2(kPeriod), 4);
    return 3.2F * wide * softStep(2.0F, 22.0F, 14.0F - p.y) + 0.35F * narrow;
}

Material matte(const char* name, const vec3& color) {
    Material m;
    m.name = name;
    m.base_color = vec4(color, 1.0F);
    m.metallic = 0.0F;
    m.roughness = 0.7F;
    m.specular = 0.0F;
    m.double_sided = true;
    return m;
}

/// A strip that leans over as it rises and ends in a point; its colour brightens to the tip.
Mesh bladeMesh(std::uint32_t material, float height, float width, float lean) {
    Mesh blade = gridMesh("blade", material, 1, kBladeRows, [&](std::uint32_t column, std::uint32_t row) {
        const float s = static_cast<float>(row) / static_cast<float>(kBladeRows);
        const float half = 0.5F * width * (1.0F - 0.96F * s * s) * (column == 0 ? -1.0F : 1.0F);
        return ShapeVertex{{half, height * s * (1.0F - 0.22F * lean * s), height * lean * s * s},
                           glm::normalize(vec3(0.0F, -2.0F * lean * s, 1.0F)),
                           {column == 0 ? 0.0F : 1.0F, 1.0F - s}};
    });
    for (const vec2& uv : blade.uv_sets[0])
        blade.colors.emplace_back(vec3(0.35F + 0.65F * (1.0F - uv.y)), 1.0F);
    return blade;
}

Mesh tuftMesh(std::uint32_t material) {
    Mesh tuft;
    tuft.name = "Tuft";
    tuft.material = material;
    for (std::uint32_t i = 0; i < kTuftBlades; ++i) {
        const Mesh blade = bladeMesh(material, 0.16F + 0.16F * hashed(i, 0, 1),
                                     0.010F + 0.008F * hashed(i, 1, 1), 0.15F + 0.75F * hashed(i, 2, 1));
        const float angle = 2.0F * kPi * hashed(i, 3, 1);
        const float away = 0.07F * std::sqrt(hashed(i, 4, 1));
        const vec3 foot(away * std::cos(angle), 0.0F, away * std::sin(angle));
        appendMesh(tuft, blade, moved(foot, 2.0F * kPi * hashed(i, 5, 1)));
    }
    return tuft;
}

/// Petals around a button.
Mesh flowerMesh(std::uint32_t material) {
    Mesh flower;
    flower.name = "Flower";
    flower.material = material;
    const auto add = [&](Mesh part, const mat4& at, const vec3& color) {
        part.colors.assign(part.positions.size(), vec4(color, 1.0F));
        appendMesh(flower, part, at);
    };
    add(coneMesh("", material, 0.004F, 0.003F, 0.34F, 5), mat4(1.0F), vec3(0.10F, 0.22F, 0.05F));
    const mat4 head = moved(vec3(0.0F, 0.34F, 0.0F)) * glm::rotate(mat4(1.0F), 0.35F, vec3(1, 0, 0));
    add(sphereMesh("", material, 0.016F, 10, 6), head, vec3(0.85F, 0.55F, 0.03F));
    constexpr std::uint32_t kPetals = 12;
    for (std::uint32_t i = 0; i < kPetals; ++i) {
        const mat4 turn =
            glm::rotate(mat4(1.0F), 2.0F * kPi * static_cast<float>(i) / kPetals, vec3(0, 1, 0));
        const Mesh petal =
            quadMesh("", material, vec3(-0.007F, 0.002F, 0.014F), vec3(-0.012F, 0.008F, 0.050F),
                     vec3(0.012F, 0.008F, 0.050F), vec3(0.007F, 0.002F, 0.014F));
        add(petal, head * turn, vec3(0.82F, 0.80F, 0.76F));
    }
    return flower;
}

mat4 planted(const vec2& at, std::uint32_t i, float size) {
    const mat4 upright = moved(vec3(at.x, heightAt(at), at.y), 2.0F * kPi * hashed(i, 1, 9));
    return glm::scale(upright, vec3(size, size * (0.7F + 0.6F * hashed(i, 2, 9)), size));
}

Mesh groundMesh(std::uint32_t material) {
    constexpr std::uint32_t kCells = 160;
    constexpr float kHalf = 0.5F * kSpacing * kSide + 1.0F;
    return gridMesh("ground", material, kCells, kCells, [](std::uint32_t column, std::uint32_t row) {
        const auto place = [](const vec2& p) { return vec3(p.x, heightAt(p), p.y); };
        const vec2 uv(static_cast<float>(column) / kCells, static_cast<float>(row) / kCells);
        const vec2 p(kHalf * (2.0F * uv.x - 1.0F), kHalf * (1.0F - 2.0F * uv.y));
        constexpr float kStep = 0.05F;
        const vec3 along_x = place(p + vec2(kStep, 0)) - place(p - vec2(kStep, 0));
        const vec3 along_z = place(p + vec2(0, kStep)) - place(p - vec2(0, kStep));
        return ShapeVertex{place(p), glm::normalize(glm::cross(along_z, along_x)), uv};
    });
}

}  // namespace

Scene makeMeadow() {
    Scene scene;
    scene.name = "meadow";
    place(scene, groundMesh(addMaterial(scene, matte("earth", vec3(0.10F, 0.085F, 0.05F)))));
    const std::array tufts{
        addMesh(scene, tuftMesh(addMaterial(scene, matte("grass", vec3(0.20F, 0.36F, 0.06F))))),
        addMesh(scene, tuftMesh(addMaterial(scene, matte("dry grass", vec3(0.42F, 0.38F, 0.13F)))))};
    scene.meshes[tufts[1]].name = "Dry tuft";
    const std::uint32_t flower = addMesh(scene, flowerMesh(addMaterial(scene, matte("flower", vec3(1.0F)))));
    for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
        const vec2 cell(static_cast<float>(i % kSide), static_cast<float>(i / kSide));
        const vec2 jitter(hashed(i, 5, 9), hashed(i, 6, 9));
        const vec2 at = kSpacing * (cell + jitter - 0.5F * static_cast<float>(kSide));
        const float dry =
            valueNoise(at / 4.0F + vec2(50.0F), uvec2(kPeriod), 7) + 0.3F * (hashed(i, 7, 9) - 0.5F);
        place(scene, tufts[dry > 0.62F ? 1 : 0], planted(at, i, 0.8F + 0.9F * hashed(i, 3, 9)));
        if (i % kFlowerEvery == 0)
            place(scene, flower, planted(at + vec2(0.05F), i + 1, 0.9F + 0.4F * hashed(i, 8, 9)));
    }

    PunctualLight sun;
    sun.name = "sun";
    sun.kind = PunctualLight::Kind::directional;
    sun.direction = -kSun;
    sun.intensity = vec3(11.0F, 9.2F, 6.6F);
    scene.lights.push_back(sun);
    scene.environment = paintSky("evening", 128, 64, [](const vec3& direction, float) {
        const float height = softStep(-0.05F, 0.6F, direction.y);
        const float glow = std::exp(-4.0F * (1.0F - glm::dot(direction, kSun)));
        return glm::mix(vec3(1.25F, 1.3F, 1.4F), vec3(0.32F, 0.60F, 1.15F), height) +
               glow * vec3(1.0F, 0.7F, 0.35F);
    });
    const vec2 stand(0.0F, 0.42F * kSpacing * kSide);
    const vec3 eye(stand.x, heightAt(stand) + 1.1F, stand.y);
    scene.cameras.push_back(lookingCamera("camera", eye, eye + vec3(0.05F, -0.14F, -1.0F), 0.75F));
    return scene;
}

}  // namespace licht
