#pragma once
#include <vector>

#include "licht/gpu/program.h"
#include "licht/on_device/flat_geometry.h"
#include "licht/on_device/record_views.h"
#include "licht/on_device/uploads.h"
#include "licht/shared/frame.h"

namespace licht {

/// What the rasteriser draws in one call.
struct Draw {
    uint first_vertex;
    uint vertex_count;
    uint first_instance;
    uint instance_count;
    VkCullModeFlags cull;
};

/// Vertices, triangles and instances on the device.
class GpuGeometry {
public:
    GpuGeometry() = default;
    GpuGeometry(Uploads& uploads, const FlatGeometry& geometry);

    void addTo(std::vector<gpu::BoundResource>& resources, const gpu::Buffer& none) const;
    void addTo(std::vector<FetchedRecords>& records) const;
    void addTo(gpu::SpecConstants& constants) const;
    void describe(FrameRecord& frame) const { frame.extra_uv_sets = extra_uv_sets_; }
    /// One per baked instance, or of very many one per row of them; one per group of instances of a mesh.
    [[nodiscard]] const std::vector<Draw>& draws() const { return draws_; }

    [[nodiscard]] const gpu::Buffer& vertices() const { return vertices_; }

private:
    gpu::Buffer vertices_, triangle_indices_, instances_, tangents_, colors_, extra_uvs_;
    std::vector<Draw> draws_;
    uint merged_instances_ = 0;  ///< that a draw may hold many of; 0: none does
    uint extra_uv_sets_ = 0;
};

}  // namespace licht
