#include "licht/run/render_loop.h"

#include <chrono>
#include <limits>

#include "licht/film/error_estimate.h"
#include "licht/render/renderer.h"
#include "licht/run/process_clock.h"

namespace licht {
namespace {

double secondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

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
    LoopResult result;
    Advance advance;
    ErrorEstimate estimate(settings.sampler, settings.first_sample);
    ErrorSchedule schedule(rules.error, settings.sampler != Sequence::random);
    const auto start = std::chrono::steady_clock::now();
    while (result.stopped_by == Stop::none) {
        renderer.renderSample();
        if (advance.samples == 0) {
            renderer.finish();
            result.first_image_seconds = secondsSinceProcessStart();
        }
        advance.samples = renderer.samples();
        advance.seconds = secondsSince(start);
        advance.interrupted = hooks.interrupted && hooks.interrupted();
        if (schedule.due(advance.samples, advance.seconds)) {
            const auto before = std::chrono::steady_clock::now();
            renderer.finish();
            const auto finished = std::chrono::steady_clock::now();
            advance.error = estimate.look(renderer.readFilm());
            advance.error_samples = advance.samples;
            advance.seconds += std::chrono::duration<double>(finished - before).count();
            schedule.checked(advance, secondsSince(finished));
        }
        if (hooks.progress) hooks.progress(progressOf(rules, advance));
        result.stopped_by = decideStop(rules, advance);
    }
    renderer.finish();
    result.render_seconds = secondsSince(start);
    result.film = renderer.readFilm();
    result.error = estimate.look(result.film);
    return result;
}

}  // namespace licht
