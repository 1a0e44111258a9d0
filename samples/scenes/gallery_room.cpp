// Walls, floor, ceiling, window and the passage behind the arch. Walls are solid, so that daylight enters
// through the window alone.
#include <cmath>
#include <cstddef>
#include <utility>

#include "samples/scenes/assembly.h"
#include "samples/scenes/gallery.h"
#include "samples/scenes/gallery_textures.h"
#include "samples/scenes/shapes.h"

namespace licht::gallery {
namespace {

constexpr float kThickness = 0.2F;
constexpr vec3 kLower = kRoom.lower;
constexpr vec3 kUpper = kRoom.upper;

struct Opening {
    float sill, lintel, back, front;
};
constexpr Opening kWindow{0.3F, 2.75F, -3.7F, 1.7F};

/// The arch: a rectangle up to the springing, a half circle above.
constexpr float kArchCentre = 2.35F;
constexpr float kArchRadius = 0.6F;
constexpr float kArchSpringing = 1.75F;
constexpr std::uint32_t kArchSegments = 32;

constexpr float kPassageBack = -6.9F;
constexpr float kPassageHeight = 2.7F;
constexpr float kPassageLeft = 1.55F;
constexpr float kPassageEnd = 5.4F;
constexpr float kPassageCorner = -5.5F;

void addBox(Scene& scene, const char* name, std::uint32_t material, const vec3& lower, const vec3& upper) {
    place(scene, boxMesh(name, material, lower, upper));
}

/// A wooden bar with its grain along its length.
void addBeam(Scene& scene, const char* name, std::uint32_t material, int axis, const vec3& lower,
             const vec3& upper) {
    place(scene, grainAlong(boxMesh(name, material, lower, upper), axis));
}

/// A level quad facing up whose uv are metres turned by `angle` and divided by `tile`.
Mesh floorMesh(const char* name, std::uint32_t material, const vec2& lower, const vec2& upper, float tile,
               float angle) {
    return gridMesh(name, material, 1, 1, [&](std::uint32_t column, std::uint32_t row) {
        const float x = column == 0 ? lower.x : upper.x;
        const float z = row == 0 ? upper.y : lower.y;
        const vec2 turned{std::cos(angle) * x - std::sin(angle) * z,
                          std::sin(angle) * x + std::cos(angle) * z};
        return ShapeVertex{{x, 0, z}, {0, 1, 0}, turned / tile};
    });
}

/// The piece of the back wall above the arch, front, back and soffit.
void addArchedWall(Scene& scene, std::uint32_t front, std::uint32_t inside) {
    const auto arch = [](std::uint32_t k) {
        const float angle = kPi * (1.0F - static_cast<float>(k) / static_cast<float>(kArchSegments));
        return vec2(kArchCentre + kArchRadius * std::cos(angle),
                    kArchSpringing + kArchRadius * std::sin(angle));
    };
    const float behind = kLower.z - kThickness;
    place(scene,
          gridMesh("arch front", front, kArchSegments, 1, [&](std::uint32_t column, std::uint32_t row) {
              const vec2 p = arch(column);
              return ShapeVertex{{p.x, row == 0 ? p.y : kUpper.y, kLower.z}, {0, 0, 1}, p};
          }));
    place(scene,
          gridMesh("arch back", inside, kArchSegments, 1, [&](std::uint32_t column, std::uint32_t row) {
              const vec2 p = arch(kArchSegments - column);
              return ShapeVertex{{p.x, row == 0 ? p.y : kUpper.y, behind}, {0, 0, -1}, p};
          }));
    place(scene,
          gridMesh("arch soffit", inside, kArchSegments, 1, [&](std::uint32_t column, std::uint32_t row) {
              const vec2 p = arch(column);
              const vec2 centre{kArchCentre, kArchSpringing};
              return ShapeVertex{{p, row == 0 ? behind : kLower.z}, {glm::normalize(centre - p), 0}, p};
          }));
}

void addWindow(Scene& scene, const Materials& m) {
    const float outer = kLower.x - kThickness;
    const auto bar = [&](const vec2& lower, const vec2& upper) {  // (y, z)
        addBox(scene, "window frame", m.steel, {outer + 0.06F, lower.x, lower.y},
               {outer + 0.12F, upper.x, upper.y});
    };
    constexpr float kBar = 0.08F;
    constexpr int kPanes = 4;
    for (int k = 0; k <= kPanes; ++k) {
        const float width = k == 0 || k == kPanes ? kBar : 0.6F * kBar;
        const float z =
            glm::mix(kWindow.back + 0.5F * kBar, kWindow.front - 0.5F * kBar, static_cast<float>(k) / kPanes);
        bar({kWindow.sill, z - 0.5F * width}, {kWindow.lintel, z + 0.5F * width});
    }
    for (const float y : {kWindow.sill, 2.05F, kWindow.lintel - kBar})
        bar({y, kWindow.back}, {y + kBar, kWindow.front});
    place(scene,
          grainAlong(roundedBoxMesh("window sill", m.oak, {0.34F, 0.05F, kWindow.front - kWindow.back + 0.2F},
                                    0.015F, 2),
                     2),
          moved({kLower.x + 0.02F, kWindow.sill - 0.02F, 0.5F * (kWindow.front + kWindow.back)}));
    for (const float z : {kWindow.front + 0.45F, kWindow.back + 0.3F}) {
        place(scene, curtainMesh("curtain", m.linen, {0.7F, 2.78F}, 7, 0.045F),
              moved({kLower.x + 0.13F, 0.03F, z}, 0.5F * kPi));
    }
    placeBar(scene, "curtain rod", m.brass, {kLower.x + 0.13F, 2.83F, kWindow.back - 0.55F},
             {kLower.x + 0.13F, 2.83F, kWindow.front + 0.6F}, 0.014F);
}

}  // namespace

Mesh grainAlong(Mesh mesh, int axis) {
    for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
        const vec3 p = mesh.positions[k];
        mesh.uv_sets[0][k] = {p[(axis + 1) % 3] + p[(axis + 2) % 3], p[axis]};
    }
    return mesh;
}

void placeBar(Scene& scene, const char* name, std::uint32_t material, const vec3& from, const vec3& to,
              float radius) {
    const vec3 along = to - from;
    const quat turned(vec3(0, 1, 0), glm::normalize(along));
    place(scene, coneMesh(name, material, radius, radius, glm::length(along), 12),
          glm::translate(mat4(1.0F), from) * glm::mat4_cast(turned));
}

void addRoom(Scene& scene, const Materials& m) {
    const float t = kThickness;
    place(scene, floorMesh("parquet", m.parquet, {kLower.x, kLower.z}, {kUpper.x, kUpper.z}, kParquetTile,
                           0.25F * kPi));
    addBox(scene, "slab", m.plaster, {kLower.x - t, -t, kPassageBack - t},
           {kPassageEnd + t, -0.01F, kUpper.z + t});
    addBox(scene, "ceiling", m.ceiling, {kLower.x - t, kUpper.y, kLower.z - t},
           {kUpper.x + t, kUpper.y + t, kUpper.z + t});
    for (int k = 0; k < 5; ++k) {
        const float z = -3.9F + 1.5F * static_cast<float>(k);
        addBeam(scene, "beam", m.dark_wood, 0, {kLower.x, kUpper.y - 0.2F, z - 0.07F},
                {kUpper.x, kUpper.y + 0.01F, z + 0.07F});
    }
    addBox(scene, "right wall", m.plaster, {kUpper.x, -t, kLower.z - t},
           {kUpper.x + t, kUpper.y + t, kUpper.z + t});
    addBox(scene, "near wall", m.plaster, {kLower.x - t, -t, kUpper.z},
           {kUpper.x + t, kUpper.y + t, kUpper.z + t});

    // The wall with the window.
    const float outer = kLower.x - t;
    addBox(scene, "wall below the window", m.plaster, {outer, -t, kLower.z - t},
           {kLower.x, kWindow.sill, kUpper.z});
    addBox(scene, "wall above the window", m.plaster, {outer, kWindow.lintel, kLower.z - t},
           {kLower.x, kUpper.y, kUpper.z});
    addBox(scene, "wall behind the window", m.plaster, {outer, kWindow.sill, kLower.z - t},
           {kLower.x, kWindow.lintel, kWindow.back});
    addBox(scene, "wall before the window", m.plaster, {outer, kWindow.sill, kWindow.front},
           {kLower.x, kWindow.lintel, kUpper.z});
    addWindow(scene, m);

    // The back wall with the arch.
    addBox(scene, "back wall", m.accent_wall, {kLower.x, -t, kLower.z - t},
           {kArchCentre - kArchRadius, kUpper.y, kLower.z});
    addBox(scene, "back wall", m.accent_wall, {kArchCentre + kArchRadius, -t, kLower.z - t},
           {kUpper.x, kUpper.y, kLower.z});
    for (const float side : {-1.0F, 1.0F}) {
        // Bare faces of the wall's ends would show the wall's colour in the arch; a thin lining hides them.
        const float face = kArchCentre + side * kArchRadius;
        addBox(scene, "arch lining", m.plaster, {face - 0.005F, 0.0F, kLower.z - t - 0.002F},
               {face + 0.005F, kArchSpringing, kLower.z});
    }
    addArchedWall(scene, m.accent_wall, m.plaster);
    const float arch_left = kArchCentre - kArchRadius;
    const float arch_right = kArchCentre + kArchRadius;
    for (const vec2& span : {vec2(kLower.x, arch_left), vec2(arch_right, kUpper.x)}) {
        addBeam(scene, "skirting", m.oak, 0, {span.x, 0.0F, kLower.z}, {span.y, 0.1F, kLower.z + 0.02F});
    }
    addBeam(scene, "skirting", m.oak, 2, {kUpper.x - 0.02F, 0.0F, kLower.z}, {kUpper.x, 0.1F, kUpper.z});
    addBeam(scene, "skirting", m.oak, 2, {kLower.x, 0.0F, kLower.z}, {kLower.x + 0.02F, 0.1F, kUpper.z});
}

void addPassage(Scene& scene, const Materials& m) {
    const float t = kThickness;
    const float front = kLower.z - t;
    const float right = kUpper.x - 0.2F;
    place(
        scene,
        floorMesh("tiles", m.tiles, {kPassageLeft - 0.1F, kPassageBack}, {kPassageEnd, kLower.z}, 1.6F, 0.0F),
        moved({0, 0.001F, 0}));
    addBox(scene, "passage ceiling", m.ceiling, {kPassageLeft - t, kPassageHeight, kPassageBack - t},
           {kPassageEnd + t, kPassageHeight + t, front});
    addBox(scene, "passage left wall", m.plaster, {kPassageLeft - t, -t, kPassageBack - t},
           {kPassageLeft, kPassageHeight + t, front});
    addBox(scene, "passage far wall", m.plaster, {kPassageLeft - t, -t, kPassageBack - t},
           {kPassageEnd + t, kPassageHeight + t, kPassageBack});
    addBox(scene, "passage corner", m.plaster, {right, -t, kPassageCorner},
           {kPassageEnd + t, kPassageHeight + t, front});
    addBox(scene, "passage end wall", m.plaster, {kPassageEnd, -t, kPassageBack - t},
           {kPassageEnd + t, kPassageHeight + t, front});
    // Out of sight: the passage sees only what its walls give back.
    place(scene, sphereMesh("hidden lamp", m.glow, 0.1F, 14, 7), moved({4.3F, 1.9F, -6.2F}));
    place(scene, roundedBoxMesh("passage plinth", m.plinth, {0.4F, 0.9F, 0.4F}, 0.01F, 1),
          moved({2.3F, 0.45F, -6.5F}));
    place(scene,
          latheMesh("passage vase", m.blue_ceramic,
                    smoothProfile({{0.0F, 0.0F},
                                   {0.09F, 0.0F},
                                   {0.17F, 0.16F},
                                   {0.15F, 0.3F},
                                   {0.05F, 0.42F},
                                   {0.06F, 0.5F},
                                   {0.045F, 0.5F},
                                   {0.035F, 0.42F},
                                   {0.0F, 0.38F}},
                                  6),
                    40),
          moved({2.3F, 0.9F, -6.5F}));
}

}  // namespace licht::gallery
