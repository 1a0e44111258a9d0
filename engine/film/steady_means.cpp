#include "licht/film/steady_means.h"

#include <algorithm>
#include <vector>

namespace licht {
namespace {

constexpr int kReach = 2;
// Of the pixel's own variance. A pixel of five hundred times the variance of those around is not believed;
// with more of it the edges of lamps would not be.
constexpr double kOwnShare = 0.002;

/// Of the pixels around.
struct Around {
    double count = 0.0, sum = 0.0, squares = 0.0, variances = 0.0;
};

Around operator+(const Around& a, const Around& b) {
    return {a.count + b.count, a.sum + b.sum, a.squares + b.squares, a.variances + b.variances};
}

Around ofPixel(const Film& film, int x, int y, int c) {
    const auto mean = static_cast<double>(film.mean.at(x, y, c));
    return {1.0, mean, mean * mean, static_cast<double>(film.variance.at(x, y, c))};
}

double steadyMean(const Around& own, const Around& around) {
    // Of fewer than two nobody knows what they differ by.
    if (around.count < 2.0) return own.sum;
    const double mean = around.sum / around.count;
    const double noise = around.variances / around.count;
    const double spread = std::max((around.squares - around.sum * mean) / (around.count - 1.0) - noise, 0.0);
    const double variance = noise + kOwnShare * own.variances;
    const double variance_around = noise / around.count + spread;
    const double both = variance + variance_around;
    return both > 0.0 ? (own.sum * variance_around + mean * variance) / both : own.sum;
}

}  // namespace

Image steadyMeans(const Film& film) {
    const int width = film.mean.width, height = film.mean.height;
    Image means(width, height, 3);
    // Of each column the rows around, with and without the middle one. Nothing is summed up to be taken off
    // again: beside a bright pixel the dim ones would be lost.
    std::vector<Around> whole(static_cast<std::size_t>(width));
    std::vector<Around> hollow(static_cast<std::size_t>(width));
    for (int c = 0; c < 3; ++c) {
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                Around& column = hollow[static_cast<std::size_t>(x)];
                column = {};
                for (int row = std::max(y - kReach, 0); row <= std::min(y + kReach, height - 1); ++row)
                    if (row != y) column = column + ofPixel(film, x, row, c);
                whole[static_cast<std::size_t>(x)] = column + ofPixel(film, x, y, c);
            }
            for (int x = 0; x < width; ++x) {
                Around around = hollow[static_cast<std::size_t>(x)];
                for (int column = std::max(x - kReach, 0); column <= std::min(x + kReach, width - 1);
                     ++column)
                    if (column != x) around = around + whole[static_cast<std::size_t>(column)];
                means.at(x, y, c) = static_cast<float>(steadyMean(ofPixel(film, x, y, c), around));
            }
        }
    }
    return means;
}

}  // namespace licht
