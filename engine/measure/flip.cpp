#include "licht/measure/flip.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "licht/colour/primaries.h"
#include "licht/colour/transfer.h"
#include "licht/core/math.h"

// Constants and their symbols are those of the paper that the header cites.

namespace licht {
namespace {

using glm::dmat3;
using glm::dvec3;

constexpr double kPiSquared = std::numbers::pi * std::numbers::pi;

/// Weights of the pixels from -radius to radius.
using Weights = std::vector<double>;

double sumOf(const Weights& weights) {
    return std::accumulate(weights.begin(), weights.end(), 0.0);
}

/// The function's values at -radius, ..., radius.
template <typename Function>
Weights sampled(int radius, const Function& function) {
    Weights weights;
    for (int x = -radius; x <= radius; ++x) weights.push_back(function(static_cast<double>(x)));
    return weights;
}

/// Filters the rows of one channel, whose first and last pixels go on outside, and makes columns of them.
Image rowsToColumns(const Image& plane, const Weights& weights) {
    const std::size_t radius = weights.size() / 2;
    const auto width = static_cast<std::size_t>(plane.width);
    std::vector<double> row(width + 2 * radius);
    std::vector<double> sums(width);
    Image result(plane.height, plane.width, 1);
    for (int y = 0; y < plane.height; ++y) {
        for (std::size_t i = 0; i < row.size(); ++i)
            row[i] = static_cast<double>(
                plane.at(static_cast<int>(std::clamp(i, radius, radius + width - 1) - radius), y, 0));
        std::fill(sums.begin(), sums.end(), 0.0);
        // Weight by weight, so that no sum waits for its last term.
        for (std::size_t k = 0; k < weights.size(); ++k)
            for (std::size_t x = 0; x < width; ++x) sums[x] += weights[k] * row[x + k];
        for (int x = 0; x < plane.width; ++x)
            result.at(y, x, 0) = static_cast<float>(sums[static_cast<std::size_t>(x)]);
    }
    return result;
}

Image filtered(const Image& plane, const Weights& along_x, const Weights& along_y) {
    return rowsToColumns(rowsToColumns(plane, along_x), along_y);
}

// What the eye resolves of a colour.

/// A term a exp(-b f^2) of a contrast sensitivity at f cycles per degree.
struct Term {
    double a, b;
};
constexpr std::array kAchromatic{Term{1.0, 0.0047}};
constexpr std::array kRedGreen{Term{1.0, 0.0053}};
constexpr std::array kBlueYellow{Term{34.1, 0.04}, Term{13.5, 0.025}};
constexpr double kWidestB = 0.04;

/// Each term is a sqrt(pi / b) exp(-pi^2 r^2 / b) at r degrees; all together weigh one.
Image sensed(const Image& plane, std::span<const Term> sensitivity, double pixels_per_degree) {
    const double widest_sigma = std::sqrt(kWidestB / (2.0 * kPiSquared));
    const auto radius = static_cast<int>(std::ceil(3.0 * widest_sigma * pixels_per_degree));
    std::vector<Weights> kernels;
    std::vector<double> shares;
    for (const Term& term : sensitivity) {
        Weights kernel = sampled(radius, [&](double x) {
            return std::exp(-kPiSquared * x * x / (term.b * pixels_per_degree * pixels_per_degree));
        });
        const double sum = sumOf(kernel);
        for (double& weight : kernel) weight /= sum;
        kernels.push_back(std::move(kernel));
        shares.push_back(term.a * std::sqrt(std::numbers::pi / term.b) * sum * sum);
    }
    const double total = sumOf(shares);
    std::vector<double> values(plane.texels.size());
    for (std::size_t k = 0; k < kernels.size(); ++k) {
        const Image blurred = filtered(plane, kernels[k], kernels[k]);
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] += shares[k] / total * static_cast<double>(blurred.texels[i]);
    }
    Image result(plane.width, plane.height, 1);
    std::transform(values.begin(), values.end(), result.texels.begin(),
                   [](double value) { return static_cast<float>(value); });
    return result;
}

// How far apart two colours are.

/// XYZ over that of white, D65 by the five digits of its table (CIE 15:2004).
dmat3 relativeXyzFromRgb() {
    Primaries primaries;
    primaries.white = {0.31271, 0.32902};
    const dmat3 xyz_from_rgb = xyzFromRgb(primaries);
    const dvec3 white = xyz_from_rgb * dvec3(1.0);
    return {xyz_from_rgb[0] / white, xyz_from_rgb[1] / white, xyz_from_rgb[2] / white};
}

/// Y, X - Y and Y - Z over white: YCxCz without its scale and offset, which a filter of weight one keeps.
const dmat3 kOpponentsFromXyz = glm::transpose(dmat3(0, 1, 0, 1, -1, 0, 0, 1, -1));

/// CIELAB of XYZ over white, its a and b less colourful in the dark (Hunt 1952, "Light and Dark Adaptation
/// and the Perception of Color").
dvec3 huntLab(const dvec3& relative_xyz) {
    constexpr double kDelta = 6.0 / 29.0;
    const auto f = [](double t) {
        return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3.0 * kDelta * kDelta) + 4.0 / 29.0;
    };
    const double fy = f(relative_xyz.y);
    const double lightness = 116.0 * fy - 16.0;
    const double hunt = 0.01 * lightness;
    return {lightness, hunt * 500.0 * (f(relative_xyz.x) - fy), hunt * 200.0 * (fy - f(relative_xyz.z))};
}

/// HyAB (Abasi, Amani Tehran and Fairchild 2020, "Distance metrics for very large color differences"),
/// compressed: to the power q_c.
double colourDistance(const dvec3& a, const dvec3& b) {
    constexpr double kPower = 0.7;
    const dvec3 d = a - b;
    return std::pow(std::abs(d.x) + std::hypot(d.y, d.z), kPower);
}

/// A distance spread over [0,1]: up to the share p_c of the largest one, that of green and blue, in
/// proportion over [0, p_t], those above it over the rest.
double colourError(double distance, double largest) {
    constexpr double kShare = 0.4;
    constexpr double kError = 0.95;
    const double knee = kShare * largest;
    return distance < knee ? kError * distance / knee
                           : kError + (distance - knee) / (largest - knee) * (1.0 - kError);
}

// Edges and points.

/// Positive weights sum to one, negative ones to minus one.
Weights balanced(Weights weights) {
    double positive = 0.0;
    double negative = 0.0;
    for (const double weight : weights) (weight > 0.0 ? positive : negative) += weight;
    for (double& weight : weights) weight /= weight > 0.0 ? positive : -negative;
    return weights;
}

/// The lengths of (value across, value down), of which `detector` finds the one.
Image lengthsOf(const Image& luminance, const Weights& detector, const Weights& blur) {
    Image lengths = filtered(luminance, detector, blur);
    const Image down = filtered(luminance, blur, detector);
    std::transform(lengths.texels.begin(), lengths.texels.end(), down.texels.begin(), lengths.texels.begin(),
                   [](float x, float y) { return std::hypot(x, y); });
    return lengths;
}

struct Features {
    Image edges, points;
};

/// By the first and the second derivative of a Gaussian, of which edges are as wide as w degrees.
Features featuresOf(const Image& luminance, double pixels_per_degree) {
    constexpr double kWidth = 0.082;
    const double sigma = 0.5 * kWidth * pixels_per_degree;
    const auto radius = static_cast<int>(std::ceil(3.0 * sigma));
    const auto gaussian = [sigma](double x) { return std::exp(-x * x / (2.0 * sigma * sigma)); };
    Weights blur = sampled(radius, gaussian);
    const double sum = sumOf(blur);
    for (double& weight : blur) weight /= sum;
    const Weights first = balanced(sampled(radius, [&](double x) { return x * gaussian(x); }));
    const Weights second =
        balanced(sampled(radius, [&](double x) { return (x * x / (sigma * sigma) - 1.0) * gaussian(x); }));
    return {lengthsOf(luminance, first, blur), lengthsOf(luminance, second, blur)};
}

/// The larger one of both differences, of which the largest possible are sqrt(2), to the power q_f = 1/2.
double featureError(double edge_difference, double point_difference) {
    const double larger = std::max(std::abs(edge_difference), std::abs(point_difference));
    return std::min(std::sqrt(larger / std::numbers::sqrt2), 1.0);
}

// Both together.

/// What an eye makes of a picture.
struct Seen {
    Image lab;
    Features features;
};

Seen see(const Image& picture, const dmat3& xyz_from_rgb, double pixels_per_degree) {
    const dmat3 opponents_from_rgb = kOpponentsFromXyz * xyz_from_rgb;
    const dmat3 rgb_from_opponents = glm::inverse(opponents_from_rgb);
    const std::size_t pixels = picture.texels.size() / 3;
    std::array<Image, 3> opponents;
    opponents.fill(Image(picture.width, picture.height, 1));
    for (std::size_t i = 0; i < pixels; ++i) {
        const float* encoded = &picture.texels[3 * i];
        const dvec3 value = opponents_from_rgb * dvec3(linearFromSrgb(encoded[0]), linearFromSrgb(encoded[1]),
                                                       linearFromSrgb(encoded[2]));
        for (int c = 0; c < 3; ++c)
            opponents[static_cast<std::size_t>(c)].texels[i] = static_cast<float>(value[c]);
    }
    Seen seen{Image(picture.width, picture.height, 3), featuresOf(opponents[0], pixels_per_degree)};
    opponents[0] = sensed(opponents[0], kAchromatic, pixels_per_degree);
    opponents[1] = sensed(opponents[1], kRedGreen, pixels_per_degree);
    opponents[2] = sensed(opponents[2], kBlueYellow, pixels_per_degree);
    for (std::size_t i = 0; i < pixels; ++i) {
        const dvec3 value(opponents[0].texels[i], opponents[1].texels[i], opponents[2].texels[i]);
        const dvec3 rgb = glm::clamp(rgb_from_opponents * value, 0.0, 1.0);
        const dvec3 lab = huntLab(xyz_from_rgb * rgb);
        for (int c = 0; c < 3; ++c)
            seen.lab.texels[3 * i + static_cast<std::size_t>(c)] = static_cast<float>(lab[c]);
    }
    return seen;
}

dvec3 labAt(const Image& lab, std::size_t pixel) {
    return {lab.texels[3 * pixel], lab.texels[3 * pixel + 1], lab.texels[3 * pixel + 2]};
}

double differenceAt(const Image& a, const Image& b, std::size_t pixel) {
    return static_cast<double>(a.texels[pixel]) - static_cast<double>(b.texels[pixel]);
}

Image displayed(Image image) {
    for (float& value : image.texels) value = srgbFromLinear(std::clamp(value, 0.0F, 1.0F));
    return image;
}

}  // namespace

Image flipMap(const Image& test, const Image& reference, double pixels_per_degree) {
    assert(test.width == reference.width && test.height == reference.height);
    assert(test.channels == 3 && reference.channels == 3 && !test.texels.empty());
    assert(pixels_per_degree >= 1.0);
    const dmat3 xyz_from_rgb = relativeXyzFromRgb();
    const double largest = colourDistance(huntLab(xyz_from_rgb[1]), huntLab(xyz_from_rgb[2]));
    const Seen a = see(test, xyz_from_rgb, pixels_per_degree);
    const Seen b = see(reference, xyz_from_rgb, pixels_per_degree);
    Image map(test.width, test.height, 1);
    for (std::size_t i = 0; i < map.texels.size(); ++i) {
        const double colour = colourError(colourDistance(labAt(a.lab, i), labAt(b.lab, i)), largest);
        const double feature = featureError(differenceAt(a.features.edges, b.features.edges, i),
                                            differenceAt(a.features.points, b.features.points, i));
        // A colour error of zero stays zero, whatever the exponent.
        map.texels[i] = static_cast<float>(colour > 0.0 ? std::pow(colour, 1.0 - feature) : 0.0);
    }
    return map;
}

double flip(const Image& test, const Image& reference, double pixels_per_degree) {
    const Image map = flipMap(test, reference, pixels_per_degree);
    return std::accumulate(map.texels.begin(), map.texels.end(), 0.0) /
           static_cast<double>(map.texels.size());
}

double flipAsDisplayed(const Image& test, const Image& reference) {
    return flip(displayed(test), displayed(reference));
}

}  // namespace licht
