#include "licht/run/render_loop.h"

#include <limits>

#include "licht/render/renderer.h"
#include "licht/run/accumulation.h"
#include "licht/run/adaptive_loop.h"
#include "licht/run/process_clock.h"

namespace licht {

ProgressState progressOf(const StopRules& rules, const Advance& advance) {
    ProgressState state;
    state.samples = advance.samples;
    state.samples_wanted = rules.samples == std::numeric_limits<std::uint32_t>::max() ? 0 : rules.samples;
    state.seconds = advance.seconds;
    state.error = advance.error;
    state.seconds_left = secondsLeft(rules, advance);
    return state;
}

LoopResult renderUntil(Renderer& renderer, const RenderSettings& settings, const StopRules& rules,
                       const LoopHooks& hooks) {
    if (settings.adaptive) return renderAdaptively(renderer, rules, hooks);
    LoopResult result;
    Accumulation picture(renderer, settings, rules.error);
    while (result.stopped_by == Stop::none) {
        renderer.renderSample();
        if (result.first_image_seconds == 0.0) {
            renderer.finish();
            result.first_image_seconds = secondsSinceProcessStart();
        }
        Advance advance = picture.look();
        advance.interrupted = hooks.interrupted && hooks.interrupted();
        if (hooks.progress) hooks.progress(progressOf(rules, advance));
        result.stopped_by = decideStop(rules, advance);
    }
    result.film = picture.finish();
    result.render_seconds = picture.advance().seconds;
    result.error = picture.advance().error;
    return result;
}

}  // namespace licht
