#include "licht/run/accumulation.h"

#include <utility>

namespace licht {
namespace {

// A filter says of its picture how wrong it is, as independent samples do.
Sequence sequenceOf(const RenderSettings& settings) {
    return settings.denoise == Denoise::none ? settings.sampler : Sequence::random;
}

}  // namespace

Accumulation::Accumulation(Renderer& renderer, const RenderSettings& settings,
                           std::optional<double> wanted_error, Seconds seconds)
    : renderer_(renderer),
      seconds_(std::move(seconds)),
      fresh_estimate_(sequenceOf(settings), settings.first_sample),
      fresh_schedule_(wanted_error, sequenceOf(settings) != Sequence::random),
      estimate_(fresh_estimate_),
      schedule_(fresh_schedule_),
      started_(seconds_()) {}

Accumulation::Seconds Accumulation::steadySeconds() {
    return [start = Clock::now()] { return secondsSince(start); };
}

void Accumulation::restart() {
    estimate_ = fresh_estimate_;
    schedule_ = fresh_schedule_;
    started_ = seconds_();
    advance_ = {};
}

const Advance& Accumulation::look() {
    advance_.samples = renderer_.samples();
    advance_.seconds = seconds_() - started_;
    if (schedule_.due(advance_.samples, advance_.seconds)) estimate();
    return advance_;
}

void Accumulation::estimate() {
    renderer_.finish();  // the samples' own time, not that of looking at them
    const double finished = seconds_();
    advance_.seconds = finished - started_;
    advance_.error = estimate_.look(renderer_.readFilm());
    advance_.error_samples = advance_.samples;
    schedule_.checked(advance_, seconds_() - finished);
}

Film Accumulation::finish() {
    renderer_.finish();
    advance_.samples = renderer_.samples();
    advance_.seconds = seconds_() - started_;
    Film film = renderer_.readFilm();
    advance_.error = estimate_.look(film);
    advance_.error_samples = advance_.samples;
    return film;
}

}  // namespace licht
