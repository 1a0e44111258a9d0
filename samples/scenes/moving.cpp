// A room in which everything moves that can: a box that slides, a lamp that circles, a lamp that is switched,
// a flag that waves, and a mirror that shows them. Whoever draws it at many times sees a film.
#include <cmath>

#include "samples/scenes/assembly.h"
#include "samples/scenes/builtin_scenes.h"
#include "samples/scenes/shapes.h"

namespace licht {
namespace {

constexpr double kBoxPeriod = 4.0;     ///< seconds, to and fro
constexpr double kCirclePeriod = 6.0;  ///< seconds a turn
constexpr double kWavePeriod = 2.0;
constexpr double kSwitchPeriod = 2.0;  ///< a half of it on, a half off

Material lamp(std::string name, float radiance) {
    Material material = matte(std::move(name), vec3(0.0F));
    material.emission = radiance * vec3(1.0F, 0.85F, 0.6F);
    return material;
}

/// Radians of a motion of that period, in single turns, so that hours lose no bits.
float phase(double seconds, double period) {
    const double turns = seconds / period;
    return static_cast<float>(2.0 * glm::pi<double>() * (turns - std::floor(turns)));
}

void addRoom(Scene& scene) {
    const std::uint32_t white = addMaterial(scene, matte("white", vec3(0.73F)));
    const std::uint32_t red = addMaterial(scene, matte("red", vec3(0.63F, 0.07F, 0.05F)));
    const std::uint32_t blue = addMaterial(scene, matte("blue", vec3(0.1F, 0.2F, 0.55F)));
    place(scene, quadMesh("floor", white, vec3(-2, 0, 2), vec3(2, 0, 2), vec3(2, 0, -2), vec3(-2, 0, -2)));
    place(scene, quadMesh("ceiling", white, vec3(-2, 3, -2), vec3(2, 3, -2), vec3(2, 3, 2), vec3(-2, 3, 2)));
    place(scene, quadMesh("back", white, vec3(-2, 0, -2), vec3(2, 0, -2), vec3(2, 3, -2), vec3(-2, 3, -2)));
    place(scene, quadMesh("left", red, vec3(-2, 0, 2), vec3(-2, 0, -2), vec3(-2, 3, -2), vec3(-2, 3, 2)));
    place(scene, quadMesh("right", blue, vec3(2, 0, -2), vec3(2, 0, 2), vec3(2, 3, 2), vec3(2, 3, -2)));
    Material silver;
    silver.name = "mirror";
    silver.base_color = vec4(0.95F, 0.95F, 0.95F, 1.0F);
    silver.roughness = 0.0F;
    place(scene, quadMesh("mirror", addMaterial(scene, silver), vec3(-0.4F, 0.5F, -1.9F),
                          vec3(1.6F, 0.5F, -1.9F), vec3(1.6F, 2.3F, -1.9F), vec3(-0.4F, 2.3F, -1.9F)));
}

/// A sheet from its staff at the left wall, in waves that run along it.
Mesh flagMesh(std::uint32_t material, float waves) {
    constexpr std::uint32_t kColumns = 24;
    constexpr std::uint32_t kRows = 12;
    constexpr vec2 kSize{1.1F, 0.7F};
    constexpr float kDepth = 0.1F;
    constexpr float kRadiansAlong = 9.0F;
    return gridMesh("flag", material, kColumns, kRows, [&](std::uint32_t column, std::uint32_t row) {
        const float u = static_cast<float>(column) / kColumns;
        const float v = static_cast<float>(row) / kRows;
        const float angle = kRadiansAlong * u - waves;
        const vec3 along(kSize.x, 0.0F, kDepth * (std::sin(angle) + kRadiansAlong * u * std::cos(angle)));
        return ShapeVertex{vec3(kSize.x * u, kSize.y * (v - 0.5F), kDepth * u * std::sin(angle)),
                           glm::normalize(glm::cross(along, vec3(0.0F, 1.0F, 0.0F))), vec2(u, 1.0F - v)};
    });
}

}  // namespace

Scene makeMoving(double seconds) {
    Scene scene;
    scene.name = "moving";
    addRoom(scene);
    const std::uint32_t yellow = addMaterial(scene, matte("yellow", vec3(0.7F, 0.55F, 0.1F)));
    const float slide = 0.9F * std::sin(phase(seconds, kBoxPeriod));
    place(scene, boxMesh("box", yellow, vec3(-0.3F, 0.0F, -0.3F), vec3(0.3F, 0.9F, 0.3F)),
          moved(vec3(slide, 0.0F, -0.6F), 0.4F));
    Material cloth = matte("cloth", vec3(0.15F, 0.5F, 0.2F));
    cloth.double_sided = true;
    place(scene, flagMesh(addMaterial(scene, cloth), phase(seconds, kWavePeriod)),
          moved(vec3(-1.95F, 1.9F, -0.8F), -0.5F));
    const float turn = phase(seconds, kCirclePeriod);
    place(scene, icosphereMesh("circling lamp", addMaterial(scene, lamp("circling", 30.0F)), 0.12F, 2),
          moved(vec3(1.1F * std::cos(turn), 2.2F, 0.2F + 0.9F * std::sin(turn))));
    const bool on = phase(seconds, kSwitchPeriod) < kPi;
    place(scene, quadMesh("switched lamp", addMaterial(scene, lamp("switched", on ? 12.0F : 0.0F)),
                          vec3(-0.5F, 2.98F, -0.5F), vec3(0.5F, 2.98F, -0.5F), vec3(0.5F, 2.98F, 0.5F),
                          vec3(-0.5F, 2.98F, 0.5F)));
    scene.cameras.push_back(lookingCamera("front", vec3(0.2F, 1.5F, 5.4F), vec3(0.0F, 1.4F, 0.0F), 0.62F));
    return scene;
}

}  // namespace licht
