#pragma once
// The Neumann series L = sum of T^i Le as a picture shows it: how much each order brings, how sure that is,
// and how much is still to come. Energy is the mean luminance of the picture, in cd/m^2.
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "licht/film/film.h"

namespace licht {

/// A number that was estimated from batches of samples.
struct Estimated {
    double value = 0.0;
    double standard_error = -1.0;  ///< negative: unknown, there is one batch alone
};

struct OrderEstimate {
    glm::dvec3 mean{0.0};  ///< of the picture, RGB, cd/m^2
    Estimated share;       ///< of the energy of all orders that were followed
};

/// What lies beyond the orders that were followed, if they go on as the last ones did: as a geometric series.
struct TailEstimate {
    double ratio = 0.0;  ///< of an order's energy to the one before, mean over the last kRatioSteps
    Estimated share;  ///< of the energy of followed and unfollowed orders; 1 where the ratio is one or more
    double lowest = 0.0;   ///< the share by the smallest of the ratios that the mean is made of
    double highest = 0.0;  ///< and by the largest: how far they are from geometric yet

    static constexpr std::uint32_t kRatioSteps = 3;
};

std::vector<OrderEstimate> estimateOrders(std::span<const LightBatch> batches);

/// Beyond `depth` (at most the deepest order of the batches): what was followed of it, and what comes behind.
/// Nothing where the orders say nothing of their ratio: there are too few, or they are dark.
std::optional<TailEstimate> estimateTail(std::span<const LightBatch> batches, std::uint32_t depth);

/// The smallest depth whose tail's share, with one standard error on top, is at most `error`; nothing when
/// none is. Of orders that are all dark: 0.
std::optional<std::uint32_t> depthFor(std::span<const LightBatch> batches, double error);

/// How much more (or less) light the first has, relative to the second; batch by batch of the same samples.
Estimated relativeDifference(std::span<const LightBatch> batches, std::span<const LightBatch> reference);

/// The share of all light that the clamp took.
Estimated lostShare(std::span<const LightBatch> batches, const glm::dvec3& kept);

/// Luminance of linear Rec. 709.
double luminanceOf(const glm::dvec3& rgb);

}  // namespace licht
