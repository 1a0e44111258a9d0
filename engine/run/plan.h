#pragma once
// What a run is asked for leaves some things to be chosen; here they are.
#include <optional>
#include <string_view>

#include "licht/gpu/device.h"
#include "licht/run/pilot.h"
#include "licht/run/stop.h"
#include "licht/scene/scene.h"
#include "licht/settings/settings.h"

namespace licht {

/// Rules without a limit of samples but for the indices that are left, where time or error ends a run.
StopRules stopRules(const RunSettings& run);

struct RunPlan {
    RenderSettings settings;  ///< for the Renderer
    StopRules rules;
    bool oidn = false;  ///< what was drawn goes through makeOidn()'s filter, of which the renderer knows
                        ///< nothing but the layers that it asks for
    std::optional<DepthChoice> depth;           ///< where a pilot chose the bounces
    std::optional<BiasMeasure> regularisation;  ///< where it is on
    std::string_view queue_trouble;  ///< the operation that the device gets wrong, so that one kernel does
                                     ///< what queues were to do; else empty
};

/// Sends the pilots that a run asks for, and chooses between queues and one kernel. pictures: so many are
/// drawn, each with the run's samples.
RunPlan planRun(gpu::Device& device, const Scene& scene, const Camera& camera, const RunSettings& run,
                std::uint32_t pictures = 1);

}  // namespace licht
