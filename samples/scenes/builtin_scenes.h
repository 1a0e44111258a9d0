#pragma once
// One function a built-in scene; each has a file of its own.
#include <cstdint>

#include "licht/scene/scene.h"

namespace licht {

Scene makeCornell();
Scene makeFurnace();
Scene makeGallery();
Scene makeEmpty();
Scene makeMeadow();
/// As it is at that time.
Scene makeMoving(double seconds);
/// kFewestTriangles to kMostTriangles, to within 1 %.
Scene makeTerrain(std::uint64_t triangles);
Scene makeSpheres(std::uint64_t triangles);
/// Exactly that many triangles shine.
Scene makeLamps(std::uint64_t triangles);

}  // namespace licht
