#include "licht/run/stop.h"

#include <algorithm>
#include <cmath>

namespace licht {
namespace {

constexpr double kSecondsBetweenChecks = 2.0;
constexpr double kShareForChecks = 0.05;

double powerOfTwoAbove(double samples) {
    return std::exp2(std::floor(std::log2(samples)) + 1.0);
}

}  // namespace

std::string_view stopName(Stop stop) {
    switch (stop) {
        case Stop::none:
            return "none";
        case Stop::samples:
            return "spp";
        case Stop::time:
            return "time";
        case Stop::error:
            return "error";
        case Stop::interrupt:
            return "interrupt";
    }
    return "none";
}

Stop decideStop(const StopRules& rules, const Advance& advance) {
    if (advance.samples == 0) return Stop::none;
    if (advance.samples >= rules.samples) return Stop::samples;
    if (rules.error && advance.error >= 0.0 && advance.error <= *rules.error &&
        advance.error_samples >= kFewestSamplesToTrust)
        return Stop::error;
    if (rules.seconds && advance.seconds >= *rules.seconds) return Stop::time;
    if (advance.interrupted) return Stop::interrupt;
    return Stop::none;
}

std::optional<double> samplesToReach(double wanted_error, const Advance& advance) {
    if (advance.error < 0.0) return std::nullopt;
    const double ratio = advance.error / wanted_error;
    return advance.error_samples * ratio * ratio;
}

double secondsLeft(const StopRules& rules, const Advance& advance) {
    if (advance.samples == 0) return -1.0;
    const double seconds_per_sample = advance.seconds / advance.samples;
    double samples_wanted = rules.samples;
    if (rules.error)
        if (const auto needed = samplesToReach(*rules.error, advance))
            samples_wanted = std::min(samples_wanted, *needed);

    const bool open_ended = samples_wanted == std::numeric_limits<std::uint32_t>::max();
    double left = open_ended ? -1.0 : std::max(0.0, (samples_wanted - advance.samples) * seconds_per_sample);
    if (rules.seconds) {
        const double until_limit = std::max(0.0, *rules.seconds - advance.seconds);
        left = left < 0.0 ? until_limit : std::min(left, until_limit);
    }
    return left;
}

bool ErrorSchedule::due(std::uint32_t samples, double seconds) const {
    if (samples < 2 || seconds < earliest_seconds_) return false;
    return samples >= next_samples_ || seconds - last_seconds_ >= kSecondsBetweenChecks;
}

void ErrorSchedule::checked(const Advance& advance, double cost) {
    spent_ += cost;
    last_seconds_ = advance.seconds;
    earliest_seconds_ = (spent_ + cost) / kShareForChecks;
    const auto needed = wanted_error_ ? samplesToReach(*wanted_error_, advance) : std::nullopt;
    next_samples_ = powerOfTwoAbove(advance.samples);
    if (needed) {
        double forecast = std::ceil(std::max<double>(*needed, kFewestSamplesToTrust));
        if (in_blocks_) {
            const double block = 0.125 * powerOfTwoAbove(forecast);
            forecast = std::ceil(forecast / block) * block;
        }
        next_samples_ = std::clamp(forecast, advance.samples + 1.0, next_samples_);
    }
}

}  // namespace licht
