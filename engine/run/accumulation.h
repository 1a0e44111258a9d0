#pragma once
#include <functional>
#include <optional>

#include "licht/core/clock.h"
#include "licht/film/error_estimate.h"
#include "licht/render/renderer.h"
#include "licht/run/stop.h"

namespace licht {

/// A picture while it grows, in a loop or before somebody's eyes: how far it has come, and how wrong it still
/// is.
class Accumulation {
public:
    /// Seconds of a clock that runs while pictures are made.
    using Seconds = std::function<double()>;

    /// `settings` are the renderer's. `wanted_error`: where known, the error is looked at when it may be
    /// reached.
    Accumulation(Renderer& renderer, const RenderSettings& settings,
                 std::optional<double> wanted_error = std::nullopt, Seconds seconds = steadySeconds());

    /// The renderer has begun anew.
    void restart();
    /// After a sample: takes note of it, and estimates the error where that is worth its time.
    const Advance& look();
    [[nodiscard]] const Advance& advance() const { return advance_; }
    /// Waits for the device, reads the film, and estimates its error once more.
    Film finish();

    static Seconds steadySeconds();

private:
    void estimate();
    Renderer& renderer_;
    Seconds seconds_;
    ErrorEstimate fresh_estimate_;
    ErrorSchedule fresh_schedule_;
    ErrorEstimate estimate_;
    ErrorSchedule schedule_;
    double started_;
    Advance advance_;
};

}  // namespace licht
