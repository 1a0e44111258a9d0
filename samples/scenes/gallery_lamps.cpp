// Lamps: emissive spheres, shades that shine faintly, and the spot lights of the pictures.
#include <cmath>

#include "samples/scenes/assembly.h"
#include "samples/scenes/gallery.h"
#include "samples/scenes/shapes.h"

namespace licht::gallery {
namespace {

void addFloorLamp(Scene& scene, const Materials& m) {
    const vec3 foot{-2.75F, 0.0F, -3.35F};
    place(scene,
          latheMesh(
              "lamp foot", m.brass,
              {{0.0F, 0.0F}, {0.16F, 0.0F}, {0.16F, 0.0F}, {0.16F, 0.015F}, {0.15F, 0.025F}, {0.0F, 0.03F}},
              48),
          moved(foot));
    placeBar(scene, "lamp pole", m.brass, foot + vec3(0, 0.02F, 0), foot + vec3(0, 1.62F, 0), 0.012F);
    place(scene, latheMesh("lamp shade", m.shade, {{0.24F, 0.0F}, {0.17F, 0.3F}}, 48),
          moved(foot + vec3(0, 1.45F, 0)));
    place(scene, sphereMesh("bulb", m.bulb, 0.045F, 14, 7), moved(foot + vec3(0, 1.62F, 0)));
}

void addTableLamp(Scene& scene, const Materials& m) {
    const vec3 foot{3.16F, 0.7F, -3.2F};
    place(scene,
          latheMesh("table lamp foot", m.terracotta,
                    smoothProfile({{0.0F, 0.0F},
                                   {0.07F, 0.0F},
                                   {0.11F, 0.07F},
                                   {0.09F, 0.16F},
                                   {0.025F, 0.24F},
                                   {0.012F, 0.28F},
                                   {0.0F, 0.28F}},
                                  6),
                    40),
          moved(foot));
    place(scene, latheMesh("table lamp shade", m.shade, {{0.17F, 0.0F}, {0.11F, 0.2F}}, 48),
          moved(foot + vec3(0, 0.27F, 0)));
    place(scene, sphereMesh("bulb", m.bulb, 0.035F, 14, 7), moved(foot + vec3(0, 0.36F, 0)));
}

void addPendants(Scene& scene, const Materials& m) {
    const std::uint32_t globe = addMesh(scene, sphereMesh("opal globe", m.globe, 0.11F, 16, 7));
    for (const vec3& centre :
         {vec3(-0.6F, 2.42F, -0.95F), vec3(-0.15F, 2.2F, -1.2F), vec3(0.2F, 2.5F, -0.75F)}) {
        place(scene, globe, moved(centre));
        place(scene, coneMesh("socket", m.brass, 0.03F, 0.02F, 0.07F, 20), moved(centre + vec3(0, 0.1F, 0)));
        placeBar(scene, "cable", m.cable, centre + vec3(0, 0.16F, 0), {centre.x, kRoom.upper.y, centre.z},
                 0.004F);
    }
}

void addSpot(Scene& scene, const Materials& m, const char* name, const vec3& position, const vec3& target,
             float candela, float cone) {
    PunctualLight light;
    light.name = name;
    light.kind = PunctualLight::Kind::spot;
    light.position = position;
    light.direction = glm::normalize(target - position);
    light.intensity = candela * vec3(1.0F, 0.82F, 0.6F);
    light.inner_cone = 0.6F * cone;
    light.outer_cone = cone;
    scene.lights.push_back(light);
    // The lamp's body ends a little behind the light, which has no size.
    placeBar(scene, "spot lamp", m.steel, position - 0.16F * light.direction,
             position - 0.02F * light.direction, 0.035F);
    placeBar(scene, "spot stem", m.steel, position - 0.12F * light.direction,
             {position.x, kRoom.upper.y, position.z - 0.12F * light.direction.z}, 0.008F);
}

}  // namespace

void addLamps(Scene& scene, const Materials& m) {
    addFloorLamp(scene, m);
    addTableLamp(scene, m);
    addPendants(scene, m);
    addSpot(scene, m, "picture spot", {-0.55F, 2.85F, -3.0F}, {-0.55F, 1.6F, -4.6F}, 7.0F, 0.6F);
    addSpot(scene, m, "sculpture spot", {1.5F, 2.85F, -2.5F}, {1.12F, 1.25F, -3.45F}, 9.0F, 0.35F);
}

}  // namespace licht::gallery
