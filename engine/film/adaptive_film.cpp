#include "licht/film/adaptive_film.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>

#include "licht/shared/frame.h"

namespace licht {
namespace {

constexpr std::uint32_t kFirstRound = 8;   // enough for a first idea of the noise
constexpr std::uint32_t kMostRound = 64;   // beyond, looking at the noise costs next to nothing
constexpr std::uint32_t kFewestRound = 2;  // a variance needs two

std::uint32_t tilesAlong(std::uint32_t pixels) {
    return (pixels + kAdaptiveTileSide - 1) / kAdaptiveTileSide;
}

vec4 texelAt(std::span<const std::byte> image, std::size_t pixel) {
    vec4 texel;
    std::memcpy(&texel, &image[pixel * sizeof(texel)], sizeof(texel));
    return texel;
}

}  // namespace

AdaptiveFilm::AdaptiveFilm(uvec2 size)
    : size_(size), columns_(tilesAlong(size.x)), rows_(tilesAlong(size.y)) {
    const std::size_t pixels = std::size_t{size.x} * size.y;
    mean_.resize(4 * pixels);
    variance_.resize(3 * pixels);
    squares_.resize(3 * pixels);
    counts_.resize(pixels);
    freedoms_.resize(pixels);
}

std::size_t AdaptiveFilm::tileOf(std::size_t pixel) const {
    const std::size_t x = pixel % size_.x, y = pixel / size_.x;
    return y / kAdaptiveTileSide * columns_ + x / kAdaptiveTileSide;
}

double AdaptiveFilm::tileShare(std::size_t tile) const {
    const auto side = [](std::size_t index, std::uint32_t pixels) {
        return std::min<std::size_t>(kAdaptiveTileSide, pixels - index * kAdaptiveTileSide);
    };
    return static_cast<double>(side(tile % columns_, size_.x) * side(tile / columns_, size_.y)) /
           (static_cast<double>(size_.x) * size_.y);
}

std::vector<std::uint32_t> AdaptiveFilm::perPixel(std::span<const std::uint32_t> tile_samples) const {
    std::vector<std::uint32_t> pixels(counts_.size());
    for (std::size_t pixel = 0; pixel < pixels.size(); ++pixel) pixels[pixel] = tile_samples[tileOf(pixel)];
    return pixels;
}

// Root of each tile's mean variance of one sample, relative as relativeError() counts it. A tile also listens
// to its neighbours: what is bright and rare shows in few of them at first.
std::vector<double> AdaptiveFilm::deviations() const {
    double picture_mean = 0.0;
    for (std::size_t pixel = 0; pixel < counts_.size(); ++pixel)
        for (std::size_t c = 0; c < 3; ++c) picture_mean += mean_[4 * pixel + c] / samples_;
    picture_mean /= 3.0 * static_cast<double>(counts_.size());
    const double floor = 0.01 * picture_mean * picture_mean;

    std::vector<double> variances(tiles());
    std::vector<double> pixels(tiles());
    for (std::size_t pixel = 0; pixel < counts_.size(); ++pixel) {
        const std::size_t tile = tileOf(pixel);
        pixels[tile] += 1.0;
        for (std::size_t c = 0; c < 3; ++c) {
            const double mean = mean_[4 * pixel + c] / samples_;
            const double variance = squares_[3 * pixel + c] / std::max(freedoms_[pixel], 1U);
            if (variance > 0.0) variances[tile] += variance / (3.0 * (mean * mean + floor));
        }
    }
    for (std::size_t tile = 0; tile < variances.size(); ++tile) variances[tile] /= pixels[tile];

    std::vector<double> result(tiles());
    constexpr std::array<double, 3> kBinomial{1.0, 2.0, 1.0};
    for (std::uint32_t y = 0; y < rows_; ++y) {
        for (std::uint32_t x = 0; x < columns_; ++x) {
            double sum = 0.0, weights = 0.0;
            for (std::uint32_t dy = 0; dy < 3; ++dy) {
                for (std::uint32_t dx = 0; dx < 3; ++dx) {
                    const std::uint32_t nx = x + dx, ny = y + dy;  // plus one
                    if (nx < 1 || ny < 1 || nx > columns_ || ny > rows_) continue;
                    const double weight = kBinomial[dx] * kBinomial[dy];
                    sum += weight * variances[std::size_t{ny - 1} * columns_ + nx - 1];
                    weights += weight;
                }
            }
            result[std::size_t{y} * columns_ + x] = std::sqrt(sum / weights);
        }
    }
    return result;
}

std::vector<std::uint32_t> AdaptiveFilm::plan(std::uint32_t budget) const {
    assert(budget >= 1);
    const double fewest = std::max<double>(std::min(budget, kFewestRound), kUniformShare * budget);
    double most = std::max(fewest, kMostShare * budget);
    std::vector<double> wanted(tiles(), budget);
    const std::vector<double> noise = samples_ > 0 ? deviations() : std::vector<double>(tiles());
    const double noisiest = *std::max_element(noise.begin(), noise.end());
    if (noisiest > 0.0 && fewest < budget) {
        // By bisection the factor for which the samples add up.
        const auto deal = [&](double factor) {
            double sum = 0.0;
            for (std::size_t tile = 0; tile < tiles(); ++tile) {
                wanted[tile] = std::min(fewest + factor * noise[tile] / noisiest, most);
                sum += wanted[tile] * tileShare(tile);
            }
            return sum;
        };
        double low = 0.0, high = most;
        // Where most tiles are free of noise the others may be full before the budget is spent.
        while (deal(high) < budget && high < 1e9 * most) high *= 2.0;
        for (int i = 0; i < 60; ++i) {
            const double middle = 0.5 * (low + high);
            (deal(middle) < budget ? low : high) = middle;
        }
        // What none of them may have is for all alike.
        const double rest = budget - deal(low);
        for (double& samples : wanted) samples += rest;
        most = std::max(most, *std::max_element(wanted.begin(), wanted.end()));
    }
    // Whole numbers with the same sum: what is cut off here is given to the next tile.
    std::vector<std::uint32_t> samples(tiles());
    double carry = 0.0;
    for (std::size_t tile = 0; tile < tiles(); ++tile) {
        const double share = tileShare(tile);
        const double exact = wanted[tile] + carry / share;
        samples[tile] = static_cast<std::uint32_t>(
            std::clamp(std::round(exact), std::floor(fewest), std::max(std::floor(most), 1.0)));
        carry = (exact - samples[tile]) * share;
    }
    return samples;
}

void AdaptiveFilm::fold(std::uint32_t budget, std::span<const std::uint32_t> tile_samples,
                        std::span<const std::byte> mean_high, std::span<const std::byte> squares_high) {
    assert(tile_samples.size() == tiles() && budget >= 1);
    const double weight = budget;
    for (std::size_t pixel = 0; pixel < counts_.size(); ++pixel) {
        const std::uint32_t n = tile_samples[tileOf(pixel)];
        const vec4 mean = texelAt(mean_high, pixel);
        const vec4 squares = texelAt(squares_high, pixel);
        for (int c = 0; c < 4; ++c)
            mean_[4 * pixel + static_cast<std::size_t>(c)] += weight * static_cast<double>(mean[c]);
        counts_[pixel] += n;
        freedoms_[pixel] += n - 1;
        if (n < 2) continue;
        for (int c = 0; c < 3; ++c) {
            const std::size_t at = 3 * pixel + static_cast<std::size_t>(c);
            const double sum = std::max(static_cast<double>(squares[c]), 0.0);
            squares_[at] += sum;
            variance_[at] += weight * weight * sum / (static_cast<double>(n) * (n - 1.0));
        }
    }
    samples_ += budget;
}

Film AdaptiveFilm::film() const {
    assert(samples_ > 0);
    Film film;
    film.size = size_;
    film.samples = samples_;
    const int width = static_cast<int>(size_.x), height = static_cast<int>(size_.y);
    film.mean = Image(width, height, 4);
    film.variance = Image(width, height, 3);
    film.counts = Image(width, height, 1);
    const double total = samples_;
    for (std::size_t i = 0; i < mean_.size(); ++i) film.mean.texels[i] = static_cast<float>(mean_[i] / total);
    for (std::size_t i = 0; i < variance_.size(); ++i)
        film.variance.texels[i] = static_cast<float>(variance_[i] / (total * total));
    for (std::size_t i = 0; i < counts_.size(); ++i) film.counts.texels[i] = static_cast<float>(counts_[i]);
    return film;
}

std::uint32_t nextRound(std::uint32_t samples, std::optional<std::uint32_t> wanted,
                        std::optional<double> affordable) {
    std::uint32_t budget = std::clamp(samples, kFirstRound, kMostRound);
    if (wanted) {
        const std::uint32_t left = *wanted - std::min(samples, *wanted);
        if (left < budget + kFirstRound) budget = left;
    }
    if (affordable) {
        const double most = std::min(*affordable, 1e9);
        if (most < budget) budget = static_cast<std::uint32_t>(std::max(most, 0.0));
        if (budget < kFewestRound && samples > 0) return 0;
    }
    return samples == 0 && (!wanted || *wanted > 0) ? std::max(budget, 1U) : budget;
}

}  // namespace licht
