#pragma once
// When a picture is done, when to look at its error, and how long it will take. Pure values, no clock of
// their own.
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

namespace licht {

enum class Stop { none, samples, time, error, interrupt };

/// "spp", "time", "error", "interrupt".
std::string_view stopName(Stop stop);

/// The first limit reached wins.
struct StopRules {
    std::uint32_t samples = std::numeric_limits<std::uint32_t>::max();  ///< per pixel, at least 1
    std::optional<double> seconds;                                      ///< of rendering
    std::optional<double> error;                                        ///< relative
};

/// How far rendering has come.
struct Advance {
    std::uint32_t samples = 0;
    double seconds = 0.0;
    double error = -1.0;              ///< relative; negative while unknown
    std::uint32_t error_samples = 0;  ///< how many samples the error was estimated from
    bool interrupted = false;
};

/// Estimates from fewer samples per pixel are shown but end nothing: a pixel that has not met its light yet
/// looks free of error.
inline constexpr std::uint32_t kFewestSamplesToTrust = 8;

Stop decideStop(const StopRules& rules, const Advance& advance);

/// Samples until the error is reached, as it falls with 1/sqrt(samples): n (error / wanted)^2. Nothing while
/// the error is unknown.
std::optional<double> samplesToReach(double wanted_error, const Advance& advance);

/// Forecast of the seconds until the first rule is met; negative when none can be told.
double secondsLeft(const StopRules& rules, const Advance& advance);

/// Reading the film to estimate its error stalls the device. This says when it is worth it: at powers of two,
/// at the count where the wanted error is forecast, at least every two seconds, and never for more than a
/// twentieth of the time. `in_blocks`: samples are even in blocks of powers of two, so a forecast is rounded
/// up to a quarter of its power of two.
class ErrorSchedule {
public:
    explicit ErrorSchedule(std::optional<double> wanted_error, bool in_blocks = false)
        : wanted_error_(wanted_error), in_blocks_(in_blocks) {}

    [[nodiscard]] bool due(std::uint32_t samples, double seconds) const;
    /// Tells what the estimate at `advance` cost in seconds.
    void checked(const Advance& advance, double cost);

private:
    std::optional<double> wanted_error_;
    bool in_blocks_;
    double next_samples_ = 4.0;
    double last_seconds_ = 0.0;
    double earliest_seconds_ = 0.0;  ///< before, the costs so far would exceed their share
    double spent_ = 0.0;
};

}  // namespace licht
