#pragma once
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <string>

namespace licht {

/// What a progress line says. Unknown values are negative.
struct ProgressState {
    std::uint64_t samples = 0;
    std::uint64_t samples_wanted = 0;  ///< 0: no sample limit
    double seconds = 0.0;
    double error = -1.0;  ///< estimated relative error
    double seconds_left = -1.0;
};

/// "16/64 samples  3.2 s  error 0.12  9.6 s left"
std::string progressText(const ProgressState& state);

/// One line that rewrites itself on a terminal, at most ten times a second; silent when the stream is no
/// terminal or quiet is asked.
class ProgressLine {
public:
    ProgressLine(std::FILE* stream, bool quiet);
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    ~ProgressLine();  ///< clears the line

    void show(const ProgressState& state);
    void show(const std::string& text);
    /// Shown even where the line was drawn just now: what is said next may be long in coming.
    void announce(const std::string& text);
    /// For what else is to be said on that stream.
    void clear();

private:
    std::FILE* stream_;
    bool active_;
    bool drawn_ = false;
    std::chrono::steady_clock::time_point last_{};
};

}  // namespace licht
