#include "licht/run/process_clock.h"

#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>

namespace licht {
namespace {

/// Seconds since boot, the clock that process start times are told in.
double now() {
    timespec time{};
    clock_gettime(CLOCK_BOOTTIME, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Field 22 of /proc/self/stat (proc(5)); the second field is the program's name in parentheses and may hold
/// anything.
std::optional<double> toldStart() {
    std::ifstream file("/proc/self/stat");
    std::string text;
    if (!std::getline(file, text)) return std::nullopt;
    const std::size_t name_end = text.rfind(')');
    if (name_end == std::string::npos) return std::nullopt;
    std::istringstream fields(text.substr(name_end + 1));
    constexpr int kFirstAfterName = 3;
    constexpr int kStartTime = 22;
    std::string skipped;
    for (int field = kFirstAfterName; field < kStartTime; ++field) fields >> skipped;
    double ticks = 0.0;
    const long ticks_per_second = sysconf(_SC_CLK_TCK);
    if (!(fields >> ticks) || ticks_per_second <= 0) return std::nullopt;
    return ticks / static_cast<double>(ticks_per_second);
}

const double kInitialised = now();

double startTime() {
    // A start after this program's own initialisers, or minutes before them, is another clock's: some
    // sandboxes tell nonsense.
    constexpr double kLongestLoading = 60.0;
    const auto told = toldStart();
    const bool plausible = told && *told <= kInitialised && *told >= kInitialised - kLongestLoading;
    return plausible ? *told : kInitialised;
}

}  // namespace

double secondsSinceProcessStart() {
    static const double start = startTime();
    return std::max(0.0, now() - start);
}

}  // namespace licht
