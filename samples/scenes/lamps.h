#pragma once
// The parts of the hall of lamps. It runs from z = 0 towards -Z: a nave, two aisles behind pillars, niches in
// the outer walls. Lengths are metres.
#include <cstdint>

#include "licht/scene/scene.h"

namespace licht::lamps {

inline constexpr float kBay = 3.6F;   ///< from pillar to pillar
inline constexpr float kNave = 2.7F;  ///< half width; the arches stand from here to kAisle
inline constexpr float kAisle = 3.3F;
inline constexpr float kWall = 5.7F;  ///< the aisle's outer wall
inline constexpr float kNicheBack = 6.3F;
inline constexpr float kNicheSill = 0.9F;
inline constexpr float kNicheLintel = 2.7F;
inline constexpr float kNicheStart = 1.0F;  ///< within a bay
inline constexpr float kNicheEnd = kBay - kNicheStart;
inline constexpr float kArch = 3.6F;  ///< height of the beams on the pillars
inline constexpr float kAisleHeight = 4.0F;
inline constexpr float kNaveHeight = 6.4F;
inline constexpr float kPillarX = 0.5F * (kNave + kAisle);
inline constexpr float kPillarRadius = 0.27F;

/// Walls, floor, ceilings and pillars of a hall of so many bays: closed, and dark.
void addHall(Scene& scene, std::uint32_t bays);

enum class Kind : std::uint8_t { panel, strip, sphere, shards };

/// Where a lamp is held, and by what.
struct Mount {
    vec3 place{0.0F};    ///< on the surface that holds it; of a sphere or shards: their centre
    vec3 normal{0.0F};   ///< away from that surface
    vec3 along{0.0F};    ///< the way its longer side runs, at a right angle to the normal
    vec3 held_at{0.0F};  ///< the other end of its cable or bracket; place where it has none
};

/// The `attempt`-th place for a lamp of that kind and outer radius in a hall of so many bays. `share` in
/// [0, 1) is how far down the hall.
Mount chooseMount(std::uint32_t bays, Kind kind, float share, float radius, std::uint32_t attempt);

}  // namespace licht::lamps
