#pragma once
#include <cstdint>
#include <vector>

#include "licht/render/pass_list.h"

namespace licht {

struct RenderStatistics {
    double bvh_seconds = 0.0;
    double upload_seconds = 0.0;
    double pipeline_seconds = 0.0;
    std::uint64_t geometry_bytes = 0;  ///< on the device: vertices, triangles, instances and the BVH
    PassTimes passes;
    std::uint64_t primary_rays = 0;  ///< pixels rasterised times samples
    std::uint64_t bounce_rays = 0;
    std::uint64_t shadow_rays = 0;
    std::uint64_t nonfinite_samples = 0;
    /// That a driver which limits the loops of a shader ended early: they may have missed a surface.
    std::uint64_t truncated_traversals = 0;
    /// Directions to the environment that rejection drew, and how many it tried for them.
    std::uint64_t environment_samples = 0;
    std::uint64_t environment_tries = 0;
    std::vector<std::uint64_t>
        order_rays;  ///< per order T^i Le, where they are kept: rays that looked for it
};

}  // namespace licht
