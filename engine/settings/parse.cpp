#include "licht/settings/parse.h"

#include <fmt/format.h>

#include <cmath>

#include "licht/core/error.h"

namespace licht {
namespace {

template <typename T>
T positive(std::string_view option, std::string_view text) {
    const auto value = wholeNumber<T>(text);
    if (value && std::isfinite(*value) && *value > T{0}) return *value;
    refuseValue(option, text, "a number greater than 0");
}

}  // namespace

void refuseValue(std::string_view option, std::string_view text, std::string_view allowed) {
    throw InputError(fmt::format("{} '{}': must be {}", option, text, allowed));
}

std::uint64_t parseCount(std::string_view option, std::string_view text, std::uint64_t lowest,
                         std::uint64_t highest) {
    const auto value = wholeNumber<std::uint64_t>(text);
    if (value && *value >= lowest && *value <= highest) return *value;
    refuseValue(option, text, fmt::format("a whole number from {} to {}", lowest, highest));
}

std::uint32_t parseCount32(std::string_view option, std::string_view text, std::uint32_t lowest,
                           std::uint32_t highest) {
    return static_cast<std::uint32_t>(parseCount(option, text, lowest, highest));
}

double parseNumber(std::string_view option, std::string_view text, double lowest, double highest) {
    const auto value = wholeNumber<double>(text);
    if (value && *value >= lowest && *value <= highest) return *value;
    refuseValue(option, text, fmt::format("a number from {} to {}", lowest, highest));
}

double parsePositive(std::string_view option, std::string_view text) {
    return positive<double>(option, text);
}

float parsePositiveFloat(std::string_view option, std::string_view text) {
    return positive<float>(option, text);
}

}  // namespace licht
