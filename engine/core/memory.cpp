#include "licht/core/memory.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <limits>
#include <optional>
#include <string>

#include "licht/core/error.h"

namespace licht {
namespace {

constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();

/// Of what is free: the rest is for what no sum knows, and for others.
constexpr double kShareOfFree = 0.85;

std::atomic<std::uint64_t>& limit() {
    static std::atomic<std::uint64_t> bytes{0};  // 0: not asked for yet
    return bytes;
}

struct Pages {
    std::uint64_t mapped = 0;
    std::uint64_t resident = 0;
};

Pages bytesOfProcess() {
    Pages pages;
    std::ifstream("/proc/self/statm") >> pages.mapped >> pages.resident;
    const auto size = static_cast<std::uint64_t>(std::max(sysconf(_SC_PAGESIZE), 1L));
    return {pages.mapped * size, pages.resident * size};
}

/// The number in a control group's file; none: there is no such file, or it says "max".
std::optional<std::uint64_t> numberIn(const char* path) {
    std::uint64_t number = 0;
    if (std::ifstream(path) >> number) return number;
    return std::nullopt;
}

std::optional<std::uint64_t> availableOnMachine() {
    std::ifstream file("/proc/meminfo");
    std::string key;
    std::uint64_t kilobytes = 0;
    std::string unit;
    while (file >> key >> kilobytes && std::getline(file, unit))
        if (key == "MemAvailable:") return kilobytes * 1024;
    return std::nullopt;
}

std::uint64_t defaultLimit() {
    const Pages now = bytesOfProcess();
    std::uint64_t free = availableOnMachine().value_or(kNoLimit);
    const auto less = [&free](std::uint64_t most, std::uint64_t used) {
        free = std::min(free, most - std::min(most, used));
    };
    for (const char* group : {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"})
        if (const auto most = numberIn(group)) less(*most, now.resident);
    rlimit space{};
    if (getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY)
        less(space.rlim_cur, now.mapped);
    if (free == kNoLimit) return kNoLimit;
    return now.resident + static_cast<std::uint64_t>(kShareOfFree * static_cast<double>(free));
}

}  // namespace

std::uint64_t memoryInUse() {
    return bytesOfProcess().resident;
}

std::uint64_t memoryLimit() {
    std::uint64_t unknown = 0;
    if (limit() == 0) limit().compare_exchange_strong(unknown, std::max<std::uint64_t>(defaultLimit(), 1));
    return limit();
}

void limitMemory(std::uint64_t bytes) {
    limit() = std::max<std::uint64_t>(bytes, 1);
}

void requireMemory(double bytes, std::string_view what) {
    const auto most = static_cast<double>(memoryLimit());
    const auto used = static_cast<double>(memoryInUse());
    if (used + bytes <= most) return;
    throw InputError(
        fmt::format("{} about {} of memory beside {} in use, and the limit is {} (--memory-limit)", what,
                    bytesInWords(bytes), bytesInWords(used), bytesInWords(most)));
}

std::string bytesInWords(double bytes) {
    constexpr double kUnit = 1024.0;
    std::string_view unit = "bytes";
    for (const std::string_view larger : {"KiB", "MiB", "GiB", "TiB"}) {
        if (bytes < kUnit) break;
        bytes /= kUnit;
        unit = larger;
    }
    return fmt::format("{:.{}f} {}", bytes, unit != "bytes" && bytes < 10.0 ? 1 : 0, unit);
}

}  // namespace licht
