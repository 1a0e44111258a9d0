#pragma once
#include "licht/command/interrupt.h"
#include "licht/command/stop.h"
#include "licht/core/progress.h"
#include "licht/render/renderer.h"

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

/// Renders sample after sample until a rule is met; at least one. `settings` are the renderer's.
LoopResult renderUntil(Renderer& renderer, const RenderSettings& settings, const StopRules& rules,
                       const InterruptWatch& interrupt, ProgressLine& progress);

}  // namespace licht
