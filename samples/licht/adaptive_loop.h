#pragma once
#include "licht/command/render_loop.h"

namespace licht {

/// Renders round after round, samples where the noise is, until a rule is met; at least one round. Rules are
/// looked at between rounds, an interruption after every frame.
LoopResult renderAdaptively(Renderer& renderer, const StopRules& rules, const InterruptWatch& interrupt,
                            ProgressLine& progress);

}  // namespace licht
