#pragma once
// How large a scene will be on the device, known before anything of it is made there.
#include <cstdint>

#include "licht/gpu/device.h"
#include "licht/on_device/flat_geometry.h"
#include "licht/scene/effects.h"
#include "licht/scene/scene.h"

namespace licht {

struct SceneSize {
    std::uint64_t vertices = 0;         ///< of baked instances, each its own, and of instanced meshes, once
    std::uint64_t baked_triangles = 0;  ///< in world space
    std::uint64_t mesh_triangles = 0;   ///< of instanced meshes
    std::uint64_t placements = 0;       ///< of instanced meshes
    std::uint64_t instances = 0;        ///< of all

    [[nodiscard]] std::uint64_t triangles() const { return baked_triangles + mesh_triangles; }
};

SceneSize sizeOnDevice(const Scene& scene, const InstanceOrder& order);

/// Throws InputError with the numbers, where shaders could not count it (kBvhMostTriangles), a buffer would
/// be larger than the device's may be, or memory will not do.
void requireRoom(const gpu::Device& device, const SceneSize& size, const Effects& effects);

}  // namespace licht
