#include "licht/scene/coarse_places.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace licht {
namespace {

/// Of an instance's size: a step between floats that is larger shows.
constexpr double kLargestStep = 0x1p-12;

struct Coarse {
    double step = 0.0;  ///< metres
    double size = 0.0;  ///< metres
    [[nodiscard]] double share() const { return step / size; }
};

double largest(const vec3& v) {
    return static_cast<double>(std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}));
}

/// Steps of floats as large as the bounds' farthest coordinate, beside the bounds' size.
Coarse coarseOf(const Bounds& bounds) {
    const double far = std::max(largest(bounds.lower), largest(bounds.upper));
    return {far * static_cast<double>(std::numeric_limits<float>::epsilon()), largest(bounds.size())};
}

Bounds boundsOf(const Mesh& mesh) {
    Bounds bounds;
    for (const vec3& position : mesh.positions)
        if (isPlace(position)) bounds.extend(position);
    return bounds;
}

Bounds inWorld(const Bounds& bounds, const mat4& world_from_object) {
    Bounds world;
    for (unsigned corner = 0; corner < 8; ++corner)
        world.extend(
            vec3(world_from_object * vec4((corner & 1U) != 0 ? bounds.upper.x : bounds.lower.x,
                                          (corner & 2U) != 0 ? bounds.upper.y : bounds.lower.y,
                                          (corner & 4U) != 0 ? bounds.upper.z : bounds.lower.z, 1.0F)));
    return world;
}

}  // namespace

void warnOfCoarsePlaces(Scene& scene) {
    std::vector<Bounds> meshes;
    for (const Mesh& mesh : scene.meshes) meshes.push_back(boundsOf(mesh));
    std::size_t count = 0;
    Coarse worst{0.0, 1.0};
    std::string name;
    for (const Instance& instance : scene.instances) {
        const Bounds& mesh = meshes[instance.mesh];
        if (mesh.empty()) continue;
        Coarse coarse = coarseOf(inWorld(mesh, instance.world_from_object));
        // Steps of the mesh's own numbers grow with it.
        if (const Coarse own = coarseOf(mesh); own.share() > coarse.share())
            coarse.step = own.share() * coarse.size;
        if (!(coarse.share() > kLargestStep)) continue;
        ++count;
        if (coarse.share() > worst.share()) {
            worst = coarse;
            name = instance.name;
        }
    }
    if (count == 0) return;
    scene.notes.push_back(
        {SceneNote::Kind::warning,
         fmt::format(
             "{} objects stand so far from the origin, or have vertices so far from their own, that "
             "their coordinates are coarse: '{}', {:.3g} m large, in steps of {:.3g} m; their light is "
             "not to be trusted",
             count, name, worst.size, worst.step)});
}

}  // namespace licht
