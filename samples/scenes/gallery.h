#pragma once
// The parts of the gallery. The room stands on y = 0; the window is in the wall at -X, the view goes along
// -Z, units are metres.
#include <cstdint>

#include "licht/scene/scene.h"

namespace licht::gallery {

/// The inner faces of the main room.
inline constexpr Bounds kRoom{{-3.4F, 0.0F, -4.6F}, {3.4F, 3.1F, 4.8F}};

/// Indices into Scene::materials.
struct Materials {
    std::uint32_t plaster, accent_wall, ceiling, parquet, tiles, dark_wood, oak, walnut, steel, linen;
    std::uint32_t rug, rug_edge, upholstery, cushion, picture, passepartout;
    std::uint32_t copper, gold, brass, mirror, plinth, white_ceramic, blue_ceramic, terracotta;
    std::uint32_t book_red, book_cream, book_blue, leaf, stem, earth;
    std::uint32_t bulb, shade, globe, glow, cable;
};

/// Adds all textures and materials.
Materials addMaterials(Scene& scene);

void addRoom(Scene& scene, const Materials& materials);
void addPassage(Scene& scene, const Materials& materials);
void addFurniture(Scene& scene, const Materials& materials);
void addArt(Scene& scene, const Materials& materials);
void addPlant(Scene& scene, const Materials& materials);
void addLamps(Scene& scene, const Materials& materials);

/// A clear late afternoon: the sun low behind the window, hills below it.
Environment afternoonSky();

/// Lays wood grain along an axis (0 to 2) of the mesh, one unit of texture a metre.
Mesh grainAlong(Mesh mesh, int axis);

/// A cylinder from one point to another.
void placeBar(Scene& scene, const char* name, std::uint32_t material, const vec3& from, const vec3& to,
              float radius);

}  // namespace licht::gallery
