#include "licht/on_device/gpu_levels.h"

#include <algorithm>
#include <bit>
#include <iterator>

#include "licht/shared/constants.h"

namespace licht {
namespace {

InstanceTransformRecord transformRecord(const BvhInstance& placed) {
    const mat3 rows = glm::transpose(placed.world_from_object);
    return {rows[0],
            placed.pivot.x,
            rows[1],
            placed.pivot.y,
            rows[2],
            placed.pivot.z,
            placed.condition,
            placed.mirrored ? 1U : 0U,
            0,
            0};
}

/// triangle: of the device's list.
TriangleName nameOf(const FlatGeometry& geometry, uint triangle) {
    if (triangle < geometry.triangle_instances.size()) {
        const uint instance = geometry.triangle_instances[triangle];
        return {triangle, instance, triangle - geometry.instances[instance].first_triangle};
    }
    const auto next =
        std::upper_bound(geometry.pieces.begin(), geometry.pieces.end(), triangle,
                         [](uint value, const MeshPiece& piece) { return value < piece.first_triangle; });
    return {triangle, 0, triangle - std::prev(next)->first_triangle};
}

/// Of every position, in order.
std::vector<vec4> positionTexels(const FlatGeometry& geometry, const JoinedBvh& bvh) {
    std::vector<vec4> texels;
    texels.reserve(std::size_t{kBvhTexelsPerTriangle} * bvh.ids.size());
    for (std::size_t i = 0; i < bvh.ids.size(); ++i) {
        const uint id = bvh.ids[i];
        if (i >= bvh.first_instance_position) {
            appendInstanceTexels(texels, geometry.placements[id]);
            continue;
        }
        const auto corner = [&](std::size_t k) {
            return geometry.vertices[geometry.indices[std::size_t{3} * id + k]].position;
        };
        appendTriangleTexels(texels, BvhTriangle{corner(0), corner(1), corner(2)}, nameOf(geometry, id));
    }
    return texels;
}

}  // namespace

GpuLevels::GpuLevels(Uploads& uploads, const FlatGeometry& geometry, BvhQuality quality, bool storage) {
    std::vector<std::vector<BvhTriangle>> meshes;
    std::vector<uint> triangle_counts{static_cast<uint>(geometry.triangle_instances.size())};
    for (const MeshPiece& piece : geometry.pieces) {
        meshes.push_back(piece.triangles);
        triangle_counts.push_back(piece.triangle_count);
    }
    TwoLevelBvh tree = buildTwoLevelBvh(worldTriangles(geometry), meshes, geometry.placements, {quality});
    build_seconds_ = tree.build_seconds;
    dropped_ = tree.baked.dropped;
    for (const Bvh& mesh : tree.meshes) dropped_ += mesh.dropped;
    top_bounds_ = tree.top_bounds;
    const JoinedBvh bvh = joinLevels(tree, triangle_counts);
    std::vector<vec4> texels = positionTexels(geometry, bvh);
    if (!geometry.placements.empty()) {
        baked_instances_ = static_cast<uint>(geometry.instances.size() - geometry.placements.size());
        first_instance_position_ = bvh.first_instance_position;
        instance_slack_ = tree.slack;
        std::vector<InstanceTransformRecord> records;
        for (const BvhInstance& placed : geometry.placements) records.push_back(transformRecord(placed));
        instance_transforms_ = uploads.buffer("instance_transforms", records);
        first_instance_texel_ = static_cast<uint>(texels.size()) - bvh.first_instance_position;
        for (std::size_t i = bvh.first_instance_position; i < bvh.ids.size(); ++i)
            texels.emplace_back(bvh.roots[geometry.placements[bvh.ids[i]].mesh], bvh.ids[i], 0.0F, 0.0F);
    }
    bvh_ = GpuBvh(uploads.device(), bvh.nodes, texels, bvh.max_stack, storage);
    uploads.count(bvh_.bytes());
}

void GpuLevels::addTo(std::vector<gpu::BoundResource>& resources, const gpu::Buffer& none) const {
    resources.push_back({"InstanceTransforms", instance_transforms_ ? &instance_transforms_ : &none});
    bvh_.addTo(resources);
}

void GpuLevels::addTo(gpu::SpecConstants& constants) const {
    constants[kConstantBakedInstances] = baked_instances_;
    constants[kConstantFirstInstancePosition] = first_instance_position_;
    constants[kConstantInstanceSlack] = std::bit_cast<uint>(instance_slack_);
    constants[kConstantFirstInstanceTexel] = first_instance_texel_;
    bvh_.addTo(constants);
}

}  // namespace licht
