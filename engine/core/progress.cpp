#include "licht/core/progress.h"

#include <fmt/format.h>
#include <unistd.h>

namespace licht {
namespace {

constexpr std::chrono::milliseconds kShortestPause{100};
// Carriage return and "erase to the end of the line" (ECMA-48, EL).
constexpr const char* kClearLine = "\r\x1b[K";

}  // namespace

std::string progressText(const ProgressState& state) {
    std::string text = state.samples_wanted > 0
                           ? fmt::format("{}/{} samples", state.samples, state.samples_wanted)
                           : fmt::format("{} samples", state.samples);
    if (state.seconds >= 0.0) text += fmt::format("  {:.1f} s", state.seconds);
    if (state.error >= 0.0) text += fmt::format("  error {:.2g}", state.error);
    if (state.seconds_left >= 0.0) text += fmt::format("  {:.1f} s left", state.seconds_left);
    return text;
}

ProgressLine::ProgressLine(std::FILE* stream, bool quiet)
    : stream_(stream), active_(!quiet && ::isatty(::fileno(stream)) == 1) {}

ProgressLine::~ProgressLine() {
    clear();
}

void ProgressLine::clear() {
    if (!drawn_) return;
    drawn_ = false;
    std::fputs(kClearLine, stream_);
    std::fflush(stream_);
}

void ProgressLine::show(const ProgressState& state) {
    show(progressText(state));
}

void ProgressLine::show(const std::string& text) {
    if (!active_) return;
    const auto now = std::chrono::steady_clock::now();
    if (drawn_ && now - last_ < kShortestPause) return;
    last_ = now;
    announce(text);
}

void ProgressLine::announce(const std::string& text) {
    if (!active_) return;
    drawn_ = true;
    std::fputs((kClearLine + text).c_str(), stream_);
    std::fflush(stream_);
}

}  // namespace licht
