#pragma once
#include "licht/run/render_loop.h"

namespace licht {

/// renderUntil() where settings.adaptive is on: round after round, samples where the noise is. Rules are
/// looked at between rounds, an interruption after every frame.
LoopResult renderAdaptively(Renderer& renderer, const StopRules& rules, const LoopHooks& hooks);

}  // namespace licht
