#include "samples/licht/frame_pattern.h"

#include <fmt/format.h>

#include "licht/core/error.h"

namespace licht {

FramePattern::FramePattern(const std::filesystem::path& pattern) : folder_(pattern.parent_path()) {
    const std::string text = pattern.filename().string();
    const auto refuse = [&] {
        throw InputError(
            fmt::format("{}: the name of a sequence's frames has one number in it, as in frame-%04d.exr",
                        pattern.string()));
    };
    const std::size_t sign = text.find('%');
    if (sign == std::string::npos || text.find('%', sign + 1) != std::string::npos) refuse();
    std::size_t at = sign + 1;
    if (at + 1 < text.size() && text[at] == '0' && text[at + 1] >= '1' && text[at + 1] <= '9') {
        places_ = text[at + 1] - '0';
        at += 2;
    }
    if (at >= text.size() || text[at] != 'd') refuse();
    before_ = text.substr(0, sign);
    behind_ = text.substr(at + 1);
}

std::filesystem::path FramePattern::of(std::uint32_t frame) const {
    return folder_ / fmt::format("{}{:0{}}{}", before_, frame, places_, behind_);
}

}  // namespace licht
