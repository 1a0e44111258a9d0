#pragma once
#include <functional>

#include "licht/core/progress.h"
#include "licht/film/film.h"
#include "licht/render/renderer.h"
#include "licht/run/stop.h"

namespace licht {

struct LoopResult {
    Stop stopped_by = Stop::none;
    double first_image_seconds = 0.0;  ///< from process start to the first complete picture
    double render_seconds = 0.0;
    double error = -1.0;  ///< of the film below; negative: unknown
    Film film;
};

/// What the progress line shows.
ProgressState progressOf(const StopRules& rules, const Advance& advance);

/// What a loop asks and tells while it runs; either may be empty.
struct LoopHooks {
    std::function<bool()> interrupted;                   ///< whether to finish early
    std::function<void(const ProgressState&)> progress;  ///< called after every sample
};

/// Renders sample after sample, or round after round where samples go where the noise is, until a rule is
/// met; at least one sample. `settings` are the renderer's.
LoopResult renderUntil(Renderer& renderer, const RenderSettings& settings, const StopRules& rules,
                       const LoopHooks& hooks = {});

}  // namespace licht
