#include "licht/run/adaptive_loop.h"

#include <limits>

#include "licht/core/clock.h"
#include "licht/film/adaptive_film.h"
#include "licht/film/error_estimate.h"
#include "licht/render/renderer.h"
#include "licht/run/process_clock.h"

namespace licht {
namespace {

std::optional<std::uint32_t> wantedSamples(const StopRules& rules) {
    return rules.samples == std::numeric_limits<std::uint32_t>::max() ? std::nullopt
                                                                      : std::optional(rules.samples);
}

/// What the seconds left are worth in samples; before the first is drawn, one.
std::optional<double> affordableSamples(const StopRules& rules, const Advance& advance) {
    if (!rules.seconds) return std::nullopt;
    if (advance.samples == 0) return 1.0;
    return (*rules.seconds - advance.seconds) * advance.samples / advance.seconds;
}

}  // namespace

LoopResult renderAdaptively(Renderer& renderer, const StopRules& rules, const LoopHooks& hooks) {
    LoopResult result;
    Advance advance;
    const auto start = Clock::now();
    std::uint32_t folded = 0;
    while (result.stopped_by == Stop::none) {
        const std::uint32_t budget =
            nextRound(folded, wantedSamples(rules), affordableSamples(rules, advance));
        if (budget == 0) {
            result.stopped_by = Stop::time;
            break;
        }
        renderer.beginRound(budget);
        while (!renderer.roundDone() && !(advance.interrupted && renderer.samples() > 0)) {
            renderer.renderSample();
            if (result.first_image_seconds == 0.0) {
                renderer.finish();
                result.first_image_seconds = secondsSinceProcessStart();
            }
            advance.samples = renderer.samples();
            advance.seconds = secondsSince(start);
            advance.interrupted = hooks.interrupted && hooks.interrupted();
            if (hooks.progress) hooks.progress(progressOf(rules, advance));
        }
        // A round that was interrupted is left out: what it has so far depends on how it would have gone on.
        if (renderer.roundDone() || folded == 0) {
            renderer.endRound();
            result.film = renderer.readFilm();
            folded = result.film.samples;
            advance.error = relativeError(result.film);
            advance.error_samples = folded;
        }
        advance.samples = folded;
        advance.seconds = secondsSince(start);
        result.stopped_by = decideStop(rules, advance);
    }
    result.render_seconds = secondsSince(start);
    result.error = relativeError(result.film);
    return result;
}

}  // namespace licht
