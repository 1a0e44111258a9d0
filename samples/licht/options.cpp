#include "samples/licht/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "samples/licht/text.h"
#include "samples/scenes/builtin.h"

namespace licht {
namespace {

/// choices: pairs of a name and what it stands for.
template <typename Choices>
auto choose(std::string_view option, std::string_view text, const Choices& choices) {
    std::string names;
    for (const auto& [name, choice] : choices) {
        if (name == text) return choice;
        names += fmt::format("{}{}", names.empty() ? "" : ", ", name);
    }
    refuseValue(option, text, "one of " + names);
}

}  // namespace

SizeRequest parseSize(std::string_view option, std::string_view text) {
    const std::size_t cross = std::min(text.find('x'), text.size());
    const std::array sides{text.substr(0, cross), text.substr(std::min(cross + 1, text.size()))};
    std::array<std::uint32_t, 2> said{};
    bool good = text.find('+') == std::string_view::npos;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        if (sides[i].empty()) continue;
        said[i] = wholeNumber<std::uint32_t>(sides[i]).value_or(0);
        good = good && said[i] >= 1 && said[i] <= kMaxPictureSide;
    }
    if (!good || (said[0] == 0 && said[1] == 0) || std::uint64_t{said[0]} * said[1] > kMaxPicturePixels)
        refuseValue(option, text,
                    fmt::format("WIDTHxHEIGHT, WIDTH or xHEIGHT, each 1 to {} and at most {} pixels together",
                                kMaxPictureSide, kMaxPicturePixels));
    return {said[0], said[1]};
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
    refuseValue(
        option, text,
        fmt::format("a count from {} to {}, as in 250000, 300k or 1M", kFewestTriangles, kMostTriangles));
}

std::uint64_t parseMemory(std::string_view option, std::string_view text) {
    constexpr double kLeast = 0x1p24;
    constexpr double kMost = 0x1p60;
    std::string_view digits = text.substr(0, text.find_first_of("MGT"));
    const std::string_view unit = text.substr(digits.size());
    const auto is = [unit](std::string_view letter) {
        return unit.starts_with(letter) &&
               (unit.size() == 1 || unit.substr(1) == "iB" || unit.substr(1) == "B");
    };
    const double factor = is("M") ? 0x1p20 : is("G") ? 0x1p30 : is("T") ? 0x1p40 : 0.0;
    const double bytes = wholeNumber<double>(digits).value_or(0.0) * factor;
    if (bytes >= kLeast && bytes <= kMost) return static_cast<std::uint64_t>(bytes);
    refuseValue(option, text, "an amount of memory of at least 16M, as in 500M, 8G");
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
    refuseValue(option, text, "R,G,B: three numbers, 0 or greater");
}

LayerSet parseLayers(std::string_view option, std::string_view text) {
    if (text == "all") return allLayers();
    std::vector<std::pair<std::string_view, LayerId>> names;
    for (const LayerInfo& layer : layerTable()) names.emplace_back(layer.name, layer.id);
    LayerSet layers;
    for (const std::string_view part : split(text, ',')) layers.add(choose(option, part, names));
    return layers;
}

std::filesystem::path parseOutput(std::string_view option, std::string_view text) {
    std::filesystem::path path(text);
    const std::string ending = lowerCase(path.extension().string());
    if (ending == ".png" || ending == ".exr") return path;
    refuseValue(option, text, "a file that ends in .png or .exr");
}

}  // namespace licht
