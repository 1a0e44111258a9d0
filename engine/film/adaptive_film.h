#pragma once
// Samples where the noise is, without bias. A picture is rendered in rounds. How a round spreads its samples
// over the tiles follows from the variances of the rounds before it alone, every pixel gets some, and the
// picture is the mean of the rounds' pictures with weights that are fixed beforehand: their samples per pixel
// on average, not what a pixel happened to get. So every round's mean, and their sum, has the right
// expectation whatever the allocation. (Weighting by a pixel's own count would not: pixels whose first
// samples missed a bright event would keep too few.)
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "licht/film/film.h"

namespace licht {

/// The picture that the rounds make together.
class AdaptiveFilm {
public:
    explicit AdaptiveFilm(uvec2 size);

    /// Samples of every pixel of each tile, row by row, in a round of `budget` (at least one) on average: as
    /// deep as the square root of the tile's relative variance, which is optimal for a sum of variances, but
    /// at least two (one, if the budget is), kUniformShare of the budget, and at most kMostShare of it,
    /// unless the others are free of noise.
    [[nodiscard]] std::vector<std::uint32_t> plan(std::uint32_t budget) const;

    /// A round as the device's history has it (mean and sum of squared deviations, RGBA32F).
    void fold(std::uint32_t budget, std::span<const std::uint32_t> tile_samples,
              std::span<const std::byte> mean_high, std::span<const std::byte> squares_high);

    /// On average over the pixels, of all rounds folded.
    [[nodiscard]] std::uint32_t samples() const { return samples_; }
    [[nodiscard]] Film film() const;

    /// Per pixel, from a number per tile.
    [[nodiscard]] std::vector<std::uint32_t> perPixel(std::span<const std::uint32_t> tile_samples) const;
    [[nodiscard]] std::size_t tiles() const { return std::size_t{columns_} * rows_; }
    /// Pixels of a tile over those of the picture.
    [[nodiscard]] double tileShare(std::size_t tile) const;

    static constexpr double kUniformShare = 0.25;
    static constexpr double kMostShare = 4.0;

private:
    [[nodiscard]] std::vector<double> deviations() const;
    [[nodiscard]] std::size_t tileOf(std::size_t pixel) const;
    uvec2 size_;
    std::uint32_t columns_, rows_;
    std::uint32_t samples_ = 0;
    std::vector<double> mean_;      ///< RGBA per pixel: round's mean times its budget
    std::vector<double> variance_;  ///< RGB: variance of the round's mean times its budget squared
    std::vector<double> squares_;   ///< RGB: squared deviations within rounds
    std::vector<std::uint32_t> counts_;
    std::vector<std::uint32_t> freedoms_;  ///< samples less one per round
};

/// The budget of the next round: as much as all rounds before, within bounds that keep looking at the noise
/// cheap and the last round short. `wanted`: samples per pixel in all, if known; `affordable`: as many as
/// seconds are left for. Zero: nothing is left to do.
std::uint32_t nextRound(std::uint32_t samples, std::optional<std::uint32_t> wanted,
                        std::optional<double> affordable);

}  // namespace licht
