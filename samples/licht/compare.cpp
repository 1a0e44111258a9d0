#include "samples/licht/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "licht/core/error.h"
#include "licht/core/file.h"
#include "licht/core/json_text.h"
#include "licht/core/memory.h"
#include "licht/image/exr.h"
#include "licht/measure/flip.h"
#include "licht/measure/metrics.h"
#include "samples/licht/commands.h"
#include "samples/licht/outputs.h"

namespace licht {
namespace {

using Json = nlohmann::ordered_json;

/// The three channels in one image, or nullopt when one is missing.
std::optional<Image> colourOf(const ExrPicture& picture, const std::string& prefix) {
    Image image(picture.width, picture.height, 3);
    constexpr std::array kNames{"R", "G", "B"};
    for (std::size_t c = 0; c < kNames.size(); ++c) {
        const ExrChannel* channel = picture.find(prefix + kNames[c]);
        if (channel == nullptr) return std::nullopt;
        for (std::size_t i = 0; i < channel->values.size(); ++i)
            image.texels[kNames.size() * i + c] = channel->values[i];
    }
    return image;
}

std::string attributeOf(const ExrPicture& picture, const std::string& name) {
    const auto found = std::find_if(picture.attributes.begin(), picture.attributes.end(),
                                    [&name](const auto& attribute) { return attribute.first == name; });
    return found == picture.attributes.end() ? std::string() : found->second;
}

/// What an attribute says as a number, or null.
Json numberOrNull(const std::string& text) {
    Json value = Json::parse(text, nullptr, false);
    return value.is_number() ? value : Json(nullptr);
}

Json pictureJson(const MeasuredPicture& picture) {
    return {{"file", picture.name},
            {"samples", numberOrNull(picture.samples)},
            {"seconds", numberOrNull(picture.seconds)},
            {"filtered", picture.filtered}};
}

Json zJson(const ZTestResult& z) {
    return {{"agree", z.regionsPassed()},
            {"pixel_pass_share", z.pass_share},
            {"smallest_block_p", z.smallest_block_p},
            {"block_threshold", z.block_threshold},
            {"smallest_whole_p", z.smallest_whole_p},
            {"whole_threshold", z.whole_threshold}};
}

Json comparisonJson(const MeasuredPicture& picture, const Comparison& c) {
    Json json = pictureJson(picture);
    json["rel_mse"] = c.rel_mse;
    json["trimmed_rel_mse"] = c.trimmed_rel_mse;
    json["mse"] = c.mse;
    json["largest_difference"] = c.largest;
    json["flip"] = c.flip;
    json["mean_ratio"] = c.mean_ratio;
    json["z_test"] = c.z ? zJson(*c.z) : Json(nullptr);
    return json;
}

std::string headText(const MeasuredPicture& reference) {
    std::string text =
        fmt::format("reference {}: {}x{}", reference.name, reference.mean.width, reference.mean.height);
    if (!reference.samples.empty()) text += fmt::format(", {} samples", reference.samples);
    if (reference.filtered) text += ", filtered";
    text += fmt::format("\ntrimmed: without the worst {} % of the pixels\n", 100.0 * kTrimmedShare);
    return text + fmt::format("{:>9}{:>9}{:>11}{:>11}{:>11}{:>11}{:>9}{:>8}{:>8}{:>8}{:>10}{:>10}  {}\n",
                              "samples", "seconds", "relMSE", "trimmed", "MSE", "largest", "FLIP", "R/R",
                              "G/G", "B/B", "block p", "whole p", "picture");
}

std::string rowText(const MeasuredPicture& picture, const Comparison& c) {
    const auto orDash = [](const std::string& text) { return text.empty() ? "-" : text; };
    std::string row =
        fmt::format("{:>9}{:>9}{:>11.4g}{:>11.4g}{:>11.4g}{:>11.4g}{:>9.5f}", orDash(picture.samples),
                    orDash(picture.seconds), c.rel_mse, c.trimmed_rel_mse, c.mse, c.largest, c.flip);
    for (const double ratio : c.mean_ratio) row += fmt::format("{:>8.4f}", ratio);
    row += c.z ? fmt::format("{:>10.2g}{:>10.2g}", c.z->smallest_block_p, c.z->smallest_whole_p)
               : fmt::format("{:>10}{:>10}", "-", "-");
    row += "  " + picture.name;
    if (picture.filtered) row += " (filtered)";
    if (c.z && !c.z->regionsPassed()) row += " (differs)";
    return row + "\n";
}

}  // namespace

MeasuredPicture readMeasured(const std::filesystem::path& path) {
    const ExrPicture file = readExr(path);
    std::optional<Image> mean = colourOf(file, "");
    if (!mean) throw InputError(fmt::format("{}: has no channels R, G and B", path.string()));
    const auto bad = std::count_if(mean->texels.begin(), mean->texels.end(),
                                   [](float value) { return !std::isfinite(value); });
    if (bad > 0)
        throw InputError(fmt::format("{}: {} of its values are no finite numbers", path.string(), bad));
    const std::string denoise = attributeOf(file, "licht.denoise");
    return {path.string(),
            std::move(*mean),
            colourOf(file, "variance."),
            attributeOf(file, "licht.spp"),
            attributeOf(file, "licht.seconds"),
            !denoise.empty() && denoise != "none"};
}

Comparison comparePictures(const MeasuredPicture& picture, const MeasuredPicture& reference) {
    const Image& a = picture.mean;
    const Image& b = reference.mean;
    if (a.width != b.width || a.height != b.height)
        throw InputError(fmt::format("{}: is {}x{}, but {} is {}x{}", picture.name, a.width, a.height,
                                     reference.name, b.width, b.height));
    Comparison result;
    result.rel_mse = relMse(a, b);
    result.trimmed_rel_mse = trimmedRelMse(a, b);
    result.mse = mse(a, b);
    result.largest = largestDifference(a, b);
    requireMemory(kFlipAsDisplayedBytesPerPixel * a.width * a.height,
                  fmt::format("{}: FLIP takes", picture.name));
    result.flip = flipAsDisplayed(a, b);
    result.mean_ratio = channelMeans(a);
    const std::vector<double> reference_means = channelMeans(b);
    for (std::size_t c = 0; c < reference_means.size(); ++c) result.mean_ratio[c] /= reference_means[c];
    // The test takes pixels for independent, which a filter's are not.
    if (picture.variance && reference.variance && !picture.filtered && !reference.filtered)
        result.z = zTest({a, *picture.variance}, {b, *reference.variance});
    return result;
}

int compare(const CompareOptions& options) {
    if (options.json) {
        checkWritable(*options.json);
        std::vector<std::filesystem::path> inputs(options.pictures.begin(), options.pictures.end());
        inputs.emplace_back(options.reference);
        requireOwnFiles(std::array{std::filesystem::path(*options.json)}, inputs);
    }
    const MeasuredPicture reference = readMeasured(options.reference);
    std::string text = headText(reference);
    Json json{{"reference", pictureJson(reference)},
              {"width", reference.mean.width},
              {"height", reference.mean.height},
              {"trimmed_share", kTrimmedShare},
              {"pictures", Json::array()}};
    bool filtered = reference.filtered;
    for (const auto& path : options.pictures) {
        const MeasuredPicture picture = readMeasured(path);
        const Comparison comparison = comparePictures(picture, reference);
        filtered = filtered || picture.filtered;
        text += rowText(picture, comparison);
        json["pictures"].push_back(comparisonJson(picture, comparison));
    }
    if (filtered) text += "filtered: no z-test, because the pixels of such a picture depend on each other\n";
    if (options.json) {
        const std::string written = jsonText(json);
        writeFile(*options.json, std::as_bytes(std::span(written)));
    }
    printOut(text);
    return 0;
}

}  // namespace licht
