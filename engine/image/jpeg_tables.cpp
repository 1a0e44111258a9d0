#include "licht/image/jpeg_tables.h"

#include <fmt/format.h>

#include <algorithm>

#include "licht/core/error.h"

namespace licht {
namespace {

using Bytes = std::span<const std::byte>;

// Markers of ITU-T T.81, table B.1, that no length follows: what stands for a byte of 255 among the codes,
// restarts, begin and end.
bool standsAlone(unsigned marker) {
    return marker <= 0x01 || (marker >= 0xd0 && marker <= 0xd9);
}

constexpr unsigned kDefineCodes = 0xc4;

/// B.2.4.2: each table is its class, 16 counts, one for each length of a code, and as many bytes as they add
/// up to. The last one may reach beyond `length`, and is read like that before it is refused.
void requireSoundTables(Bytes tables, std::size_t length, const std::string& name) {
    constexpr std::size_t kLengths = 16;
    constexpr std::size_t kMostCodes = 256;
    while (length > 0) {
        if (tables.size() < 1 + kLengths) throw InputError(fmt::format("{}: the image is truncated", name));
        std::size_t codes = 0;
        for (const std::byte count : tables.subspan(1, kLengths))
            codes += std::to_integer<std::size_t>(count);
        if (codes > kMostCodes)
            throw InputError(fmt::format("{}: broken image (a table of {} codes)", name, codes));
        const std::size_t size = 1 + kLengths + codes;
        tables = tables.subspan(std::min(size, tables.size()));
        length -= std::min(size, length);
    }
}

}  // namespace

void requireSoundJpegTables(Bytes bytes, const std::string& name) {
    // From marker to marker, B.1.1.2: among codes 255 is followed by 0, elsewhere a length says how far the
    // next one is.
    while (bytes.size() >= 2) {
        const auto at = [&](std::size_t i) { return std::to_integer<unsigned>(bytes[i]); };
        if (at(0) != 0xff || at(1) == 0xff || standsAlone(at(1))) {
            bytes = bytes.subspan(1);
            continue;
        }
        if (bytes.size() < 4) throw InputError(fmt::format("{}: the image is truncated", name));
        const std::size_t length = std::max(at(2) << 8U | at(3), 2U);
        if (at(1) == kDefineCodes) requireSoundTables(bytes.subspan(4), length - 2, name);
        bytes = bytes.subspan(std::min(2 + length, bytes.size()));
    }
}

}  // namespace licht
