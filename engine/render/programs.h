#pragma once
#include <optional>

#include "licht/gpu/program.h"
#include "licht/render/reprojection.h"
#include "licht/render/scene_on_device.h"
#include "licht/render/spatial_filter.h"
#include "licht/render/wavefront.h"
#include "licht/settings/settings.h"

namespace licht {

/// What the programs of a frame are specialised to: what the scene calls for, and the settings.
gpu::SpecConstants programConstants(const SceneOnDevice& scene, const RenderSettings& settings);

/// Every program of a frame, compiled once: pictures of all sizes use the same ones.
struct Programs {
    Programs(gpu::Device& device, const gpu::SpecConstants& constants, const RenderSettings& settings);

    gpu::Program gbuffer;
    std::uint32_t paths_per_thread;              ///< of the next
    gpu::Program path;                           ///< one kernel for whole paths, or instead
    std::optional<WavefrontPrograms> wavefront;  ///< where settings.queues
    gpu::Program accumulate;
    gpu::Program layers;                   ///< where any are asked for
    std::optional<FilterPrograms> filter;  ///< where settings ask for it
    std::optional<HistoryPrograms> history;
    gpu::Program tonemap;
};

}  // namespace licht
