#include "licht/image/hdr_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "licht/core/error.h"

namespace licht {
namespace {

/// Takes the next line off the text, without its end.
std::string_view takeLine(std::string_view& text) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return line;
}

/// So many numbers, separated by blanks; nullopt where something else stands there.
template <std::size_t Count>
std::optional<std::array<double, Count>> numbersIn(std::string_view text) {
    std::array<double, Count> numbers{};
    for (double& number : numbers) {
        text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
        if (text.starts_with('+')) text.remove_prefix(1);
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (error != std::errc{} || !std::isfinite(number)) return std::nullopt;
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    }
    return text.find_first_not_of(" \t") == std::string_view::npos ? std::optional(numbers) : std::nullopt;
}

class HeaderReader {
public:
    explicit HeaderReader(const std::string& name) : name_(name) {}

    HdrHeader read(std::string_view text) {
        takeLine(text);  // the magic
        while (!text.empty()) {
            const std::string_view line = takeLine(text);
            if (line.empty()) {
                requireTopLeft(takeLine(text));
                break;
            }
            readVariable(line);
        }
        return header_;
    }

private:
    [[noreturn]] void refuse(std::string_view what) const {
        throw InputError(fmt::format("{}: {}", name_, what));
    }

    void readVariable(std::string_view line) {
        const std::size_t equals = line.find('=');
        if (equals == std::string_view::npos || line.front() == '#') return;
        const std::string_view key = line.substr(0, equals);
        const std::string_view value = line.substr(equals + 1);
        if (key == "FORMAT" && value != "32-bit_rle_rgbe")
            refuse(value == "32-bit_rle_xyze" ? "its numbers are XYZ (32-bit_rle_xyze), RGB is read"
                                              : "its FORMAT is not 32-bit_rle_rgbe");
        if (key == "EXPOSURE") divideBy(key, numbersIn<1>(value));
        if (key == "COLORCORR") divideBy(key, numbersIn<3>(value));
        if (key == "PRIMARIES") {
            const auto xy = numbersIn<8>(value);
            if (!xy) refuse("its PRIMARIES are not eight numbers");
            // Converters write zeros where they know none.
            if (*xy == std::array<double, 8>{}) return;
            header_.primaries = {
                {(*xy)[0], (*xy)[1]}, {(*xy)[2], (*xy)[3]}, {(*xy)[4], (*xy)[5]}, {(*xy)[6], (*xy)[7]}};
        }
    }

    template <std::size_t Count>
    void divideBy(std::string_view key, const std::optional<std::array<double, Count>>& factors) {
        for (std::size_t c = 0; c < 3; ++c) {
            const double factor = factors ? (*factors)[c % Count] : 0.0;
            if (!(factor > 0.0)) refuse(fmt::format("its {} is no positive number", key));
            header_.divisor[static_cast<int>(c)] *= factor;
        }
    }

    void requireTopLeft(std::string_view resolution) const {
        if (resolution.substr(0, 3) == "-Y " && resolution.find("+X ") != std::string_view::npos) return;
        refuse(fmt::format("its rows go by '{}', only -Y +X (from the top left) is read",
                           resolution.substr(0, 40)));
    }

    const std::string& name_;
    HdrHeader header_;
};

}  // namespace

HdrHeader readHdrHeader(std::span<const std::byte> bytes, const std::string& name) {
    return HeaderReader(name).read({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace licht
