// The Cornell box as it was measured: Cornell University Program of Computer Graphics, "The Cornell Box:
// Data" (1998); the box is that of Goral, Torrance, Greenberg and Battaile, "Modeling the interaction of
// light between diffuse surfaces" (1984) in its later form with two blocks. The geometry is given there in
// millimetres; reflectances and emission are the linear Rec. 709 values commonly used for the measured
// spectra.
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "samples/scenes/assembly.h"
#include "samples/scenes/builtin_scenes.h"
#include "samples/scenes/shapes.h"

namespace licht {
namespace {

using Corners = std::array<vec3, 4>;

/// Counter-clockwise seen from inside the box, in millimetres.
constexpr Corners kFloor{{{552.8F, 0, 0}, {0, 0, 0}, {0, 0, 559.2F}, {549.6F, 0, 559.2F}}};
constexpr Corners kCeiling{{{556, 548.8F, 559.2F}, {0, 548.8F, 559.2F}, {0, 548.8F, 0}, {556, 548.8F, 0}}};
constexpr Corners kLight{{{343, 548.8F, 332}, {213, 548.8F, 332}, {213, 548.8F, 227}, {343, 548.8F, 227}}};
constexpr Corners kBackWall{
    {{549.6F, 0, 559.2F}, {0, 0, 559.2F}, {0, 548.8F, 559.2F}, {556, 548.8F, 559.2F}}};
constexpr Corners kRightWall{{{0, 0, 559.2F}, {0, 0, 0}, {0, 548.8F, 0}, {0, 548.8F, 559.2F}}};
constexpr Corners kLeftWall{{{552.8F, 0, 0}, {549.6F, 0, 559.2F}, {556, 548.8F, 559.2F}, {556, 548.8F, 0}}};
/// The tops of the blocks, counter-clockwise seen from above.
constexpr Corners kShortBlock{{{130, 165, 65}, {82, 165, 225}, {240, 165, 272}, {290, 165, 114}}};
constexpr Corners kTallBlock{{{423, 330, 247}, {265, 330, 296}, {314, 330, 456}, {472, 330, 406}}};

constexpr vec3 kWhite{0.725F, 0.71F, 0.68F};
constexpr vec3 kRed{0.63F, 0.065F, 0.05F};
constexpr vec3 kGreen{0.14F, 0.45F, 0.091F};
constexpr vec3 kLightReflectance{0.78F};
constexpr vec3 kLightEmission{17, 12, 4};

vec3 metres(const vec3& millimetres) {
    return millimetres / 1000.0F;
}

Mesh corneredQuad(std::string name, std::uint32_t material, const Corners& corners) {
    return quadMesh(std::move(name), material, metres(corners[0]), metres(corners[1]), metres(corners[2]),
                    metres(corners[3]));
}

/// The ceiling goes around the light, corner by corner, so that the light lies in it and nothing overlaps.
Mesh ceilingMesh(std::uint32_t material) {
    Mesh ceiling;
    ceiling.name = "ceiling";
    ceiling.material = material;
    for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t next = (k + 1) % 4;
        appendMesh(ceiling,
                   corneredQuad({}, material, {kCeiling[k], kCeiling[next], kLight[next], kLight[k]}));
    }
    return ceiling;
}

/// Top and four sides; it stands on the floor and has no bottom, as in the data.
Mesh blockMesh(std::string name, std::uint32_t material, const Corners& top) {
    Mesh block = corneredQuad(std::move(name), material, top);
    for (std::size_t k = 0; k < 4; ++k) {
        const vec3 left = top[k];
        const vec3 right = top[(k + 1) % 4];
        appendMesh(block, corneredQuad({}, material,
                                       {vec3(left.x, 0, left.z), vec3(right.x, 0, right.z), right, left}));
    }
    return block;
}

}  // namespace

Scene makeCornell() {
    Scene scene;
    scene.name = "cornell";
    const std::uint32_t white = addMaterial(scene, matte("white", kWhite));
    const std::uint32_t red = addMaterial(scene, matte("red", kRed));
    const std::uint32_t green = addMaterial(scene, matte("green", kGreen));
    Material lamp = matte("light", kLightReflectance);
    lamp.emission = kLightEmission;
    const std::uint32_t light = addMaterial(scene, std::move(lamp));

    place(scene, corneredQuad("floor", white, kFloor));
    place(scene, ceilingMesh(white));
    place(scene, corneredQuad("back wall", white, kBackWall));
    place(scene, corneredQuad("left wall", red, kLeftWall));
    place(scene, corneredQuad("right wall", green, kRightWall));
    place(scene, blockMesh("short block", white, kShortBlock));
    place(scene, blockMesh("tall block", white, kTallBlock));
    place(scene, corneredQuad("light", light, kLight));

    // A film of 25 mm square behind a lens of 35 mm focal length.
    const float y_fov = 2.0F * std::atan(0.0125F / 0.035F);
    const vec3 eye = metres({278, 273, -800});
    scene.cameras.push_back(lookingCamera("published view", eye, eye + vec3(0, 0, 1), y_fov));
    scene.cameras.back().aspect = 1.0F;
    scene.default_exposure = 1.0;
    return scene;
}

}  // namespace licht
