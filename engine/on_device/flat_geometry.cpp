#include "licht/on_device/flat_geometry.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "licht/bvh/ray_setup.h"
#include "licht/scene/instancing.h"
#include "licht/shared/bvh_numerics.h"
#include "licht/shared/effects.h"
#include "licht/shared/index.h"

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
    const bool mirrored = mirrors(world_from_object);
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

void addVertices(FlatGeometry& out, const Mesh& mesh, const mat4& transform, const Effects& effects) {
    const DirectionTransform to_world = directionTransform(transform);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        VertexRecord v{};
        v.position = vec3(transform * vec4(mesh.positions[i], 1.0F));
        if (!mesh.normals.empty()) v.normal = normalizeOrZero(to_world.cofactors * mesh.normals[i]);
        v.u = mesh.uv(0, i).x;
        v.v = mesh.uv(0, i).y;
        out.vertices.push_back(v);
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
        for (uint set = 1; set <= out.extra_uv_sets; ++set) out.extra_uvs.push_back(mesh.uv(set, i));
    }
}

uint instanceFlags(const Mesh& mesh, const Material& material) {
    uint flags = 0;
    if (material.double_sided) flags |= kInstanceDoubleSided;
    if (material.alpha_mode != AlphaMode::opaque) flags |= kInstanceAlpha;
    if (!mesh.tangents.empty()) flags |= kInstanceTangents;
    return flags;
}

void addTriangles(FlatGeometry& out, const Mesh& mesh, uint first_vertex, bool mirrored) {
    for (uvec3 t : mesh.triangles) {
        if (mirrored) std::swap(t.y, t.z);
        const auto corner = [&](uint i) { return out.vertices[first_vertex + i].position; };
        // What rays cannot meet is not drawn either.
        if (!isUsable({corner(t.x), corner(t.y), corner(t.z)})) t = uvec3(t.x);
        for (int c = 0; c < 3; ++c) out.indices.push_back(first_vertex + t[c]);
    }
}

std::vector<BvhTriangle> trianglesFrom(const FlatGeometry& geometry, std::size_t first, std::size_t count) {
    std::vector<BvhTriangle> triangles;
    triangles.reserve(count);
    for (std::size_t i = 3 * first; i < 3 * (first + count); i += 3)
        triangles.push_back({geometry.vertices[geometry.indices[i]].position,
                             geometry.vertices[geometry.indices[i + 1]].position,
                             geometry.vertices[geometry.indices[i + 2]].position});
    return triangles;
}

InstanceRecord instanceRecord(const Scene& scene, const Mesh& mesh, uint first_triangle, uint first_light) {
    InstanceRecord record{};
    record.first_triangle = first_triangle;
    record.material = mesh.material;
    record.first_light = first_light;
    record.flags = instanceFlags(mesh, scene.materials[mesh.material]);
    return record;
}

uint triangleCount(const FlatGeometry& geometry) {
    return static_cast<uint>(geometry.indices.size() / 3);
}

// The mesh as it is, seen from its centre.
MeshPiece addPiece(FlatGeometry& out, const Mesh& mesh, const vec3& centre, const Effects& effects) {
    MeshPiece piece;
    piece.first_triangle = triangleCount(out);
    piece.triangle_count = static_cast<uint>(mesh.triangles.size());
    const auto first_vertex = static_cast<uint>(out.vertices.size());
    addVertices(out, mesh, glm::translate(mat4(1.0F), -centre), effects);
    addTriangles(out, mesh, first_vertex, false);
    piece.triangles = trianglesFrom(out, piece.first_triangle, piece.triangle_count);
    return piece;
}

}  // namespace

InstanceOrder orderInstances(const Scene& scene, const Effects& effects) {
    const auto count = static_cast<uint>(scene.instances.size());
    InstanceOrder order;
    order.scene_instance.resize(count);
    std::iota(order.scene_instance.begin(), order.scene_instance.end(), 0U);
    order.baked = count;
    if (effects.has(kEffectInstances)) {
        const Instancing instancing = chooseInstanced(scene);
        const auto group = [&](uint i) {
            const Instance& instance = scene.instances[i];
            const bool mirrored = mirrors(instance.world_from_object);
            return instancing.instanced[i] != 0 ? std::tuple(true, instance.mesh, mirrored)
                                                : std::tuple(false, 0U, false);
        };
        std::stable_sort(order.scene_instance.begin(), order.scene_instance.end(),
                         [&](uint a, uint b) { return group(a) < group(b); });
        order.baked = count - instancing.count;
    }
    order.device_instance.resize(count);
    for (uint i = 0; i < count; ++i) order.device_instance[order.scene_instance[i]] = i;
    return order;
}

FlatGeometry flattenGeometry(const Scene& scene, const Effects& effects, const InstanceOrder& order,
                             const std::vector<uint>& first_light) {
    FlatGeometry out;
    out.extra_uv_sets = extraUvSets(scene, effects);
    for (uint i = 0; i < order.baked; ++i) {
        const Instance& instance = scene.instances[order.scene_instance[i]];
        const Mesh& mesh = scene.meshes[instance.mesh];
        const auto first_vertex = static_cast<uint>(out.vertices.size());
        out.instances.push_back(
            instanceRecord(scene, mesh, triangleCount(out), first_light[order.scene_instance[i]]));
        addVertices(out, mesh, instance.world_from_object, effects);
        addTriangles(out, mesh, first_vertex, directionTransform(instance.world_from_object).mirrored);
        out.triangle_instances.resize(triangleCount(out), i);
    }
    for (const VertexRecord& vertex : out.vertices) {
        const vec3 distance = glm::abs(vertex.position);
        if (std::max({distance.x, distance.y, distance.z}) <= kBvhLargestCoordinate)
            out.bounds.extend(vertex.position);
    }

    uint current = kNone;  // the mesh of the last piece
    vec3 centre(0.0F);
    for (uint i = order.baked; i < order.scene_instance.size(); ++i) {
        const Instance& instance = scene.instances[order.scene_instance[i]];
        const Mesh& mesh = scene.meshes[instance.mesh];
        if (instance.mesh != current) {
            current = instance.mesh;
            centre = meshCentre(mesh);
            out.pieces.push_back(addPiece(out, mesh, centre, effects));
        }
        out.instances.push_back(instanceRecord(scene, mesh, out.pieces.back().first_triangle, kNoIndex));
        out.placements.push_back(
            makeBvhInstance(static_cast<uint>(out.pieces.size() - 1), instance.world_from_object, centre)
                .value());
    }
    return out;
}

std::vector<BvhTriangle> worldTriangles(const FlatGeometry& geometry) {
    return trianglesFrom(geometry, 0, geometry.triangle_instances.size());
}

}  // namespace licht
