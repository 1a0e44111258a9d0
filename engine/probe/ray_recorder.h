#pragma once
#include <array>
#include <string_view>
#include <vector>

#include "licht/gpu/device.h"
#include "licht/on_device/gpu_scene.h"
#include "licht/scene/scene.h"
#include "licht/shared/ray_records.h"

namespace licht {

/// Rays of one kind in the order in which the renderer's invocations trace them: 8x8 pixels a tile, tile
/// after tile.
struct RayList {
    std::string_view kind;  ///< primary, shadow, bounce1, bounce2 or glossy
    bool any_hit = false;   ///< whether something is hit is all that is asked
    std::vector<RayRecord> rays;
};

/// The rays that the renderer traces for one sample a pixel of this view, written down by the path tracer
/// itself. shadow: those of the first vertices, then those of the second ones. bounce1, bounce2: scattered at
/// the first and second vertex, where every surface is taken as its Lambertian base. primary: what the
/// rasteriser stands for. glossy: leaving the first vertex by a GGX lobe of kRecordedRoughness. A path that
/// has no such ray leaves no gap. Throws InputError for a picture whose lists are larger than the device's
/// buffers.
std::vector<RayList> recordRays(gpu::Device& device, const GpuScene& scene, const Camera& camera, uvec2 size);

}  // namespace licht
