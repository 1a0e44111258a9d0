#include "licht/render/flat_geometry.h"

#include <algorithm>

namespace licht {
namespace {

// How directions of an instance go to the world. Normals take the cofactors, which need no division: inverse
// transpose = cofactors / det.
struct DirectionTransform {
    mat3 linear;
    mat3 cofactors;
    bool mirrored;
};

DirectionTransform directionTransform(const mat4& world_from_object) {
    const mat3 m(world_from_object);
    const mat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    const bool mirrored = glm::dot(m[0], cofactors[0]) < 0.0F;
    return {m, mirrored ? -cofactors : cofactors, mirrored};
}

vec3 normalizeOrZero(const vec3& v) {
    const float length = glm::length(v);
    return length > 0.0F && length < kInfinity ? v / length : vec3(0.0F);
}

uint extraUvSets(const Scene& scene, const Effects& effects) {
    std::size_t sets = 1;
    if (effects.has(kEffectExtraUvSets))
        for (const Mesh& mesh : scene.meshes) sets = std::max(sets, mesh.uv_sets.size());
    return static_cast<uint>(sets - 1);
}

void addVertices(FlatGeometry& out, const Mesh& mesh, const Instance& instance,
                 const DirectionTransform& to_world, const Effects& effects) {
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        VertexRecord v{};
        v.position = vec3(instance.world_from_object * vec4(mesh.positions[i], 1.0F));
        if (!mesh.normals.empty()) v.normal = normalizeOrZero(to_world.cofactors * mesh.normals[i]);
        if (!mesh.uv_sets.empty()) {
            v.u = mesh.uv_sets[0][i].x;
            v.v = mesh.uv_sets[0][i].y;
        }
        out.vertices.push_back(v);
        out.bounds.extend(v.position);
        if (effects.has(kEffectNormalMaps)) {
            vec4 t(0.0F);
            if (!mesh.tangents.empty()) {
                t = mesh.tangents[i];
                t = vec4(normalizeOrZero(to_world.linear * vec3(t)), to_world.mirrored ? -t.w : t.w);
            }
            out.tangents.push_back(t);
        }
        if (effects.has(kEffectVertexColors))
            out.colors.push_back(mesh.colors.empty() ? vec4(1.0F) : mesh.colors[i]);
        for (uint set = 1; set <= out.extra_uv_sets; ++set)
            out.extra_uvs.push_back(set < mesh.uv_sets.size() ? mesh.uv_sets[set][i] : vec2(0.0F));
    }
}

uint instanceFlags(const Mesh& mesh, const Material& material) {
    uint flags = 0;
    if (material.double_sided) flags |= kInstanceDoubleSided;
    if (material.alpha_mode != AlphaMode::opaque) flags |= kInstanceAlpha;
    if (!mesh.tangents.empty()) flags |= kInstanceTangents;
    return flags;
}

}  // namespace

FlatGeometry flattenGeometry(const Scene& scene, const Effects& effects,
                             const std::vector<uint>& first_light) {
    FlatGeometry out;
    out.extra_uv_sets = extraUvSets(scene, effects);
    for (uint i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const Mesh& mesh = scene.meshes[instance.mesh];
        const DirectionTransform to_world = directionTransform(instance.world_from_object);
        const auto first_vertex = static_cast<uint>(out.vertices.size());
        InstanceRecord record{};
        record.first_triangle = static_cast<uint>(out.triangle_instances.size());
        record.material = mesh.material;
        record.first_light = first_light[i];
        record.flags = instanceFlags(mesh, scene.materials[mesh.material]);
        out.instances.push_back(record);
        addVertices(out, mesh, instance, to_world, effects);
        for (uvec3 t : mesh.triangles) {
            if (to_world.mirrored) std::swap(t.y, t.z);
            for (int c = 0; c < 3; ++c) out.indices.push_back(first_vertex + t[c]);
            out.triangle_instances.push_back(i);
        }
    }
    return out;
}

std::vector<BvhTriangle> worldTriangles(const FlatGeometry& geometry) {
    std::vector<BvhTriangle> triangles;
    triangles.reserve(geometry.triangle_instances.size());
    for (std::size_t i = 0; i < geometry.indices.size(); i += 3)
        triangles.push_back({geometry.vertices[geometry.indices[i]].position,
                             geometry.vertices[geometry.indices[i + 1]].position,
                             geometry.vertices[geometry.indices[i + 2]].position});
    return triangles;
}

}  // namespace licht
