#include "licht/on_device/scene_size.h"

#include <fmt/format.h>

#include <algorithm>

#include "licht/core/error.h"
#include "licht/shared/bvh_layout.h"
#include "licht/shared/effects.h"

namespace licht {
namespace {

// What building takes at its peak, on the host and on a device that shares its memory: measured,
// tests/bench/MEASURED.md, "Memory".
constexpr double kBytesOfTriangle = 180.0;
constexpr double kBytesOfVertex = 70.0;
constexpr double kBytesOfInstance = 100.0;

/// A buffer's elements, by the device's limits.
void requireBuffer(const gpu::Device& device, const char* name, std::uint64_t count,
                   std::uint64_t bytes_each) {
    const VkPhysicalDeviceLimits& limits = device.limits();
    const std::uint64_t bytes = count * bytes_each;
    const std::uint64_t as_texels = std::uint64_t{limits.maxTexelBufferElements} * sizeof(vec4);
    const std::uint64_t most = std::max<std::uint64_t>(as_texels, limits.maxStorageBufferRange);
    if (bytes > most || bytes > device.largestAllocation())
        throw InputError(
            fmt::format("the scene has {} {}, which take {} bytes; a buffer of '{}' holds at most {}", count,
                        name, bytes, device.report().name, std::min(most, device.largestAllocation())));
}

}  // namespace

SceneSize sizeOnDevice(const Scene& scene, const InstanceOrder& order) {
    SceneSize size;
    size.instances = order.scene_instance.size();
    size.placements = size.instances - order.baked;
    std::uint32_t last = kNone;
    for (std::size_t i = 0; i < order.scene_instance.size(); ++i) {
        const std::uint32_t m = scene.instances[order.scene_instance[i]].mesh;
        const Mesh& mesh = scene.meshes[m];
        if (i < order.baked) {
            size.vertices += mesh.positions.size();
            size.baked_triangles += mesh.triangles.size();
        } else if (m != last) {
            last = m;
            size.vertices += mesh.positions.size();
            size.mesh_triangles += mesh.triangles.size();
        }
    }
    return size;
}

void requireRoom(const gpu::Device& device, const SceneSize& size, const Effects& effects) {
    // Triangles, instances and places in the tree are numbered by floats and by three bytes.
    if (size.triangles() + size.placements > kBvhMostTriangles || size.instances > kBvhMostTriangles)
        throw InputError(fmt::format(
            "the scene has {} triangles ({} of them in instanced meshes) and {} instances ({} of them share "
            "meshes); at most {} can be traced together",
            size.triangles(), size.mesh_triangles, size.instances, size.placements, kBvhMostTriangles));
    requireBuffer(device, "vertices", size.vertices, sizeof(VertexRecord));
    requireBuffer(device, "instances", size.instances, sizeof(InstanceRecord));
    requireBuffer(device, "triangles", size.triangles() + size.placements,
                  kBvhTexelsPerTriangle * sizeof(vec4));
    double vertex = kBytesOfVertex;
    for (const uint effect : {kEffectNormalMaps, kEffectVertexColors, kEffectExtraUvSets})
        if (effects.has(effect)) vertex += 2.0 * sizeof(vec4);
    device.requireMemory(vertex * static_cast<double>(size.vertices) +
                             kBytesOfTriangle * static_cast<double>(size.triangles()) +
                             kBytesOfInstance * static_cast<double>(size.instances),
                         fmt::format("the scene's {} triangles, {} vertices and {} instances take",
                                     size.triangles(), size.vertices, size.instances));
}

}  // namespace licht
