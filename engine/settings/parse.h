#pragma once
// Values from text. Each parser throws an InputError that names the option, the text and what is allowed.
#include <charconv>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>

#include "licht/settings/choices.h"

namespace licht {

[[noreturn]] void refuseValue(std::string_view option, std::string_view text, std::string_view allowed);

/// The whole text as a number, with a sign of either kind, or nothing.
template <typename T>
std::optional<T> wholeNumber(std::string_view text) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    T value{};
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || stop != end) return std::nullopt;
    return value;
}

/// A whole number from lowest to highest.
std::uint64_t parseCount(std::string_view option, std::string_view text, std::uint64_t lowest,
                         std::uint64_t highest);
/// The same for the 32-bit settings.
std::uint32_t parseCount32(std::string_view option, std::string_view text, std::uint32_t lowest,
                           std::uint32_t highest);
/// A number from lowest to highest.
double parseNumber(std::string_view option, std::string_view text, double lowest, double highest);
/// Finite and greater than zero.
double parsePositive(std::string_view option, std::string_view text);
/// The same, as a float.
float parsePositiveFloat(std::string_view option, std::string_view text);

/// One of what can be chosen by name (choices.h).
template <typename Choice>
Choice parseChoice(std::string_view option, std::string_view text,
                   std::span<const NamedChoice<Choice>> choices = choicesOf<Choice>()) {
    std::string names;
    for (const auto& known : choices) {
        if (known.name == text) return known.choice;
        if (!names.empty()) names += ", ";
        names += known.name;
    }
    refuseValue(option, text, "one of " + names);
}

}  // namespace licht
