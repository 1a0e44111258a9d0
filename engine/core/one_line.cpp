#include "licht/core/one_line.h"

#include <cstdint>

namespace licht {
namespace {

struct Character {
    std::uint32_t code = 0;
    std::size_t bytes = 1;
    bool valid = false;
};

/// The first character (RFC 3629): shortest form, no surrogates, at most U+10FFFF.
Character firstOf(std::string_view text) {
    const auto byte = [text](std::size_t i) {
        return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i]));
    };
    const std::uint32_t lead = byte(0);
    if (lead < 0x80U) return {lead, 1, true};
    const std::size_t bytes = lead >= 0xf0U ? 4 : lead >= 0xe0U ? 3 : 2;
    if (lead < 0xc2U || lead > 0xf4U || text.size() < bytes) return {};
    std::uint32_t code = lead & (0x7fU >> bytes);
    for (std::size_t i = 1; i < bytes; ++i) {
        if ((byte(i) & 0xc0U) != 0x80U) return {};
        code = code << 6U | (byte(i) & 0x3fU);
    }
    constexpr std::uint32_t kLeast[] = {0, 0, 0x80U, 0x800U, 0x10000U};
    const bool surrogate = code >= 0xd800U && code <= 0xdfffU;
    if (code < kLeast[bytes] || surrogate || code > 0x10ffffU) return {};
    return {code, bytes, true};
}

bool steersTheTerminal(std::uint32_t code) {
    const bool control = code < 0x20U || (code >= 0x7fU && code < 0xa0U);
    const bool line_end = code == 0x2028U || code == 0x2029U;
    const bool direction = code == 0x061cU || code == 0x200eU || code == 0x200fU ||
                           (code >= 0x202aU && code <= 0x202eU) || (code >= 0x2066U && code <= 0x2069U);
    return control || line_end || direction;
}

}  // namespace

std::string oneLine(std::string_view text, std::size_t limit) {
    std::string line;
    bool cut = false;
    while (!text.empty() && !cut) {
        const Character c = firstOf(text);
        const std::string_view shown = !c.valid                    ? std::string_view("?")
                                       : steersTheTerminal(c.code) ? std::string_view(" ")
                                                                   : text.substr(0, c.bytes);
        cut = line.size() + shown.size() > limit;
        if (!cut) line += shown;
        text.remove_prefix(c.bytes);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    return cut ? line + "..." : line;
}

}  // namespace licht
