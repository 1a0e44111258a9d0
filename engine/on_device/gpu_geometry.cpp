#include "licht/on_device/gpu_geometry.h"

#include "licht/shared/constants.h"

namespace licht {
namespace {

std::size_t bakedInstances(const FlatGeometry& geometry) {
    return geometry.instances.size() - geometry.placements.size();
}

// Above, draws are merged (tests/bench/MEASURED.md, "Memory"); below, the vertex program need not search.
constexpr std::size_t kMostDraws = 1024;

uint mergedInstances(const FlatGeometry& geometry) {
    const std::size_t baked = bakedInstances(geometry);
    return baked > kMostDraws ? static_cast<uint>(baked) : 0;
}

// glTF: back faces of single-sided materials are not drawn. Rays meet both sides, so that visibility stays
// symmetric.
std::vector<Draw> drawsOf(const FlatGeometry& geometry) {
    const auto cull = [](const InstanceRecord& record, VkCullModeFlags back) {
        return (record.flags & kInstanceDoubleSided) != 0 ? VkCullModeFlags{VK_CULL_MODE_NONE} : back;
    };
    std::vector<Draw> draws;
    const std::size_t baked = bakedInstances(geometry);
    const bool merged = mergedInstances(geometry) > 0;
    for (std::size_t i = 0; i < baked; ++i) {
        const uint first = geometry.instances[i].first_triangle;
        const uint end = i + 1 < baked ? geometry.instances[i + 1].first_triangle
                                       : static_cast<uint>(geometry.triangle_instances.size());
        const VkCullModeFlags mode = cull(geometry.instances[i], VK_CULL_MODE_BACK_BIT);
        if (merged && !draws.empty() && draws.back().cull == mode) {
            draws.back().vertex_count += 3 * (end - first);
            continue;
        }
        draws.push_back({3 * first, 3 * (end - first), static_cast<uint>(i), 1, mode});
    }
    for (std::size_t k = 0; k < geometry.placements.size(); ++k) {
        const BvhInstance& placed = geometry.placements[k];
        if (k > 0 && placed.mesh == geometry.placements[k - 1].mesh &&
            placed.mirrored == geometry.placements[k - 1].mirrored) {
            ++draws.back().instance_count;
            continue;
        }
        const MeshPiece& piece = geometry.pieces[placed.mesh];
        draws.push_back({3 * piece.first_triangle, 3 * piece.triangle_count, static_cast<uint>(baked + k), 1,
                         cull(geometry.instances[baked + k],
                              placed.mirrored ? VK_CULL_MODE_FRONT_BIT : VK_CULL_MODE_BACK_BIT)});
    }
    return draws;
}

}  // namespace

GpuGeometry::GpuGeometry(Uploads& uploads, const FlatGeometry& geometry)
    : vertices_(uploads.buffer("vertices", geometry.vertices, kFetchedUsage)),
      triangle_indices_(uploads.buffer("triangle_indices", geometry.indices, kFetchedUsage)),
      instances_(uploads.buffer("instances", geometry.instances, kFetchedUsage)),
      tangents_(uploads.bufferIfAny("tangents", geometry.tangents)),
      colors_(uploads.bufferIfAny("colors", geometry.colors)),
      extra_uvs_(uploads.bufferIfAny("extra_uvs", geometry.extra_uvs)),
      draws_(drawsOf(geometry)),
      merged_instances_(mergedInstances(geometry)),
      extra_uv_sets_(geometry.extra_uv_sets) {}

void GpuGeometry::addTo(std::vector<gpu::BoundResource>& resources, const gpu::Buffer& none) const {
    resources.insert(resources.end(), {{"Tangents", tangents_ ? &tangents_ : &none},
                                       {"Colors", colors_ ? &colors_ : &none},
                                       {"ExtraUvs", extra_uvs_ ? &extra_uvs_ : &none}});
}

void GpuGeometry::addTo(gpu::SpecConstants& constants) const {
    constants[kConstantMergedInstances] = merged_instances_;
}

void GpuGeometry::addTo(std::vector<FetchedRecords>& records) const {
    records.insert(records.end(),
                   {{"Vertices", "vertex_texels", &vertices_},
                    {"TriangleIndices", "triangle_index_texels", &triangle_indices_, VK_FORMAT_R32_UINT},
                    {"Instances", "instance_texels", &instances_}});
}

}  // namespace licht
