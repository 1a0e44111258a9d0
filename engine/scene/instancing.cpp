#include "licht/scene/instancing.h"

#include <algorithm>

#include "licht/bvh/instances.h"

namespace licht {

vec3 meshCentre(const Mesh& mesh) {
    Bounds bounds;
    for (const uvec3& triangle : mesh.triangles) {
        for (int corner = 0; corner < 3; ++corner) {
            if (const vec3& p = mesh.positions[triangle[corner]]; isPlace(p)) {
                bounds.extend(p);
            }
        }
    }
    return bounds.empty() ? vec3(0.0F) : bounds.centre();
}

Instancing chooseInstanced(const Scene& scene) {
    std::vector<std::uint32_t> uses(scene.meshes.size());
    for (const Instance& instance : scene.instances) {
        ++uses[instance.mesh];
    }
    const auto saved = [&](std::size_t mesh) -> std::uint64_t {
        const Mesh& m = scene.meshes[mesh];
        const Material& material = scene.materials[m.material];
        const bool emits = !material.unlit && material.emission != vec3(0.0F);
        const std::uint64_t triangles = m.triangles.size();
        const std::uint64_t others = triangles * (std::max(uses[mesh], 1U) - 1U);
        return emits || triangles < kLeastInstancedTriangles || others < kLeastSavedByMesh ? 0 : others;
    };

    Instancing result;
    result.instanced.assign(scene.instances.size(), 0);
    std::vector<std::uint8_t> shared(scene.meshes.size());
    std::vector<vec3> centres(scene.meshes.size());
    std::uint64_t saved_by_scene = 0;
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        const std::uint64_t by_mesh = saved(i);
        saved_by_scene += by_mesh;
        shared[i] = by_mesh > 0 ? 1 : 0;
    }
    if (saved_by_scene < kLeastSavedByScene) {
        return result;
    }
    std::vector<std::uint32_t> instances(scene.meshes.size());
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        if (shared[i] != 0) {
            centres[i] = meshCentre(scene.meshes[i]);
        }
    }
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        if (shared[instance.mesh] != 0 &&
            makeBvhInstance(0, instance.world_from_object, centres[instance.mesh])) {
            result.instanced[i] = 1;
            ++result.count;
            if (++instances[instance.mesh] > result.most_uses) {
                result.most_uses = instances[instance.mesh];
                result.most_used = instance.mesh;
            }
        }
    }
    return result;
}

}  // namespace licht
