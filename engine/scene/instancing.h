#pragma once
// Which instances of a scene share their mesh's memory, and which are baked into one piece.
#include <cstdint>
#include <vector>

#include "licht/scene/scene.h"

namespace licht {

// A mesh that is stored once takes a fraction of the memory and of the time to build, and its rays cost more
// than twice as much (tests/bench/MEASURED.md, rays). So meshes are shared only where memory matters.

/// A mesh of fewer triangles is always baked.
inline constexpr std::uint64_t kLeastInstancedTriangles = 32;
/// Triangles that sharing must save a mesh, and all meshes together, before there are two levels at all (the
/// latter are about 32 MB).
inline constexpr std::uint64_t kLeastSavedByMesh = 4096;
inline constexpr std::uint64_t kLeastSavedByScene = 262144;

struct Instancing {
    std::vector<std::uint8_t> instanced;  ///< per instance of the scene: 1, or 0 for a baked one
    std::uint32_t count = 0;              ///< of ones
    std::uint32_t most_used = kNone;      ///< the mesh with the most instances; kNone: all are baked
    std::uint32_t most_uses = 0;
};

/// A pure function of the scene. Baked are: meshes that emit (their triangles are lights, in world space),
/// transforms that cannot be undone safely (makeBvhInstance), and all where sharing saves little memory,
/// because one level is faster (the numbers above).
Instancing chooseInstanced(const Scene& scene);

/// The middle of what the mesh's triangles span; instances are placed relative to it.
vec3 meshCentre(const Mesh& mesh);

}  // namespace licht
