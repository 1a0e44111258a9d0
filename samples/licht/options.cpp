#include "samples/licht/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <charconv>
#include <cmath>
#include <span>
#include <utility>

#include "licht/core/error.h"
#include "licht/settings/choices.h"
#include "samples/licht/text.h"
#include "samples/scenes/builtin.h"

namespace licht {
namespace {

constexpr double kMaxExposure = 64.0;

[[noreturn]] void refuse(std::string_view option, std::string_view text, std::string_view allowed) {
    throw InputError(fmt::format("{} '{}': must be {}", option, oneLine(text), allowed));
}

/// The whole text as a number, or nothing.
template <typename T>
std::optional<T> wholeNumber(std::string_view text) {
    T value{};
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || stop != end) return std::nullopt;
    return value;
}

/// choices: pairs of a name and what it stands for.
template <typename Choices>
auto choose(std::string_view option, std::string_view text, const Choices& choices) {
    std::string names;
    for (const auto& [name, choice] : choices) {
        if (name == text) return choice;
        names += fmt::format("{}{}", names.empty() ? "" : ", ", name);
    }
    refuse(option, text, "one of " + names);
}

}  // namespace

uvec2 parseSize(std::string_view option, std::string_view text) {
    const std::size_t cross = text.find('x');
    if (cross != std::string_view::npos) {
        const auto width = wholeNumber<std::uint32_t>(text.substr(0, cross));
        const auto height = wholeNumber<std::uint32_t>(text.substr(cross + 1));
        const auto inRange = [](std::optional<std::uint32_t> side) {
            return side && *side >= 1 && *side <= kMaxPictureSide;
        };
        if (inRange(width) && inRange(height) && std::uint64_t{*width} * *height <= kMaxPicturePixels)
            return {*width, *height};
    }
    refuse(option, text,
           fmt::format("WIDTHxHEIGHT, each 1 to {} and at most {} pixels together", kMaxPictureSide,
                       kMaxPicturePixels));
}

std::uint64_t parseTriangles(std::string_view option, std::string_view text) {
    std::string_view digits = text;
    double unit = 1.0;
    if (!digits.empty() && (digits.back() == 'k' || digits.back() == 'M')) {
        unit = digits.back() == 'k' ? 1e3 : 1e6;
        digits.remove_suffix(1);
    }
    const auto value = wholeNumber<double>(digits);
    const double count = value.value_or(0.0) * unit;
    if (count >= static_cast<double>(kFewestTriangles) && count <= static_cast<double>(kMostTriangles))
        return static_cast<std::uint64_t>(std::llround(count));
    refuse(option, text,
           fmt::format("a count from {} to {}, as in 250000, 300k or 1M", kFewestTriangles, kMostTriangles));
}

std::uint64_t parseCount(std::string_view option, std::string_view text, std::uint64_t lowest,
                         std::uint64_t highest) {
    const auto value = wholeNumber<std::uint64_t>(text);
    if (value && *value >= lowest && *value <= highest) return *value;
    refuse(option, text, fmt::format("a whole number from {} to {}", lowest, highest));
}

std::uint32_t parseCount32(std::string_view option, std::string_view text, std::uint32_t lowest,
                           std::uint32_t highest) {
    return static_cast<std::uint32_t>(parseCount(option, text, lowest, highest));
}

double parsePositive(std::string_view option, std::string_view text) {
    const auto value = wholeNumber<double>(text);
    if (value && std::isfinite(*value) && *value > 0.0) return *value;
    refuse(option, text, "a number greater than 0");
}

float parsePositiveFloat(std::string_view option, std::string_view text) {
    const auto value = wholeNumber<float>(text);
    if (value && std::isfinite(*value) && *value > 0.0F) return *value;
    refuse(option, text, "a number greater than 0");
}

double parseAngle(std::string_view option, std::string_view text) {
    constexpr double kWholeSky = 180.0;
    const auto value = wholeNumber<double>(text);
    if (value && *value >= 0.0 && *value <= kWholeSky) return *value;
    refuse(option, text, fmt::format("degrees from 0 to {}", kWholeSky));
}

double parseExposure(std::string_view option, std::string_view text) {
    const auto value = wholeNumber<double>(text);
    if (value && std::abs(*value) <= kMaxExposure) return *value;
    refuse(option, text, fmt::format("a number from {} to {}", -kMaxExposure, kMaxExposure));
}

vec3 parseColour(std::string_view option, std::string_view text) {
    const std::vector<std::string_view> parts = split(text, ',');
    vec3 colour{0.0F};
    bool good = parts.size() == 3;
    for (int i = 0; good && i < 3; ++i) {
        const auto value = wholeNumber<float>(parts[static_cast<std::size_t>(i)]);
        good = value && std::isfinite(*value) && *value >= 0.0F;
        if (good) colour[i] = *value;
    }
    if (good) return colour;
    refuse(option, text, "R,G,B: three numbers, 0 or greater");
}

template <typename Choice>
Choice parseChoice(std::string_view option, std::string_view text) {
    return choose(option, text, choicesOf<Choice>());
}

template Tonemap parseChoice(std::string_view, std::string_view);
template QueueUse parseChoice(std::string_view, std::string_view);
template BvhQuality parseChoice(std::string_view, std::string_view);
template DirectLight parseChoice(std::string_view, std::string_view);
template MisHeuristic parseChoice(std::string_view, std::string_view);
template LightChoice parseChoice(std::string_view, std::string_view);
template EnvironmentSampling parseChoice(std::string_view, std::string_view);
template Sequence parseChoice(std::string_view, std::string_view);

std::uint32_t blueBitsFor(std::optional<std::uint32_t> samples) {
    constexpr std::uint32_t kUnknown = 4, kMost = 10;
    if (!samples) return kUnknown;
    return std::min(static_cast<std::uint32_t>(std::bit_width(*samples - 1)), kMost);
}

Layers parseLayers(std::string_view option, std::string_view text) {
    Layers layers;
    const std::array<std::pair<std::string_view, bool*>, 7> names{{{"albedo", &layers.aovs.albedo},
                                                                   {"normal", &layers.aovs.normal},
                                                                   {"depth", &layers.aovs.depth},
                                                                   {"motion", &layers.aovs.motion},
                                                                   {"variance", &layers.variance},
                                                                   {"sampleCount", &layers.sample_count},
                                                                   {"bounces", &layers.orders}}};
    if (text == "all") {
        for (const auto& [name, wanted] : names) *wanted = true;
        return layers;
    }
    for (const std::string_view part : split(text, ',')) *choose(option, part, names) = true;
    return layers;
}

std::filesystem::path parseOutput(std::string_view option, std::string_view text) {
    std::filesystem::path path(text);
    const std::string ending = lowerCase(path.extension().string());
    if (ending == ".png" || ending == ".exr") return path;
    refuse(option, text, "a file that ends in .png or .exr");
}

}  // namespace licht
