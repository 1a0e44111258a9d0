#include "licht/film/orders.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "licht/colour/transfer.h"

namespace licht {
namespace {

constexpr std::size_t kEveryBatch = std::numeric_limits<std::size_t>::max();

/// Energy by order over all batches but one.
std::vector<double> energies(std::span<const LightBatch> batches, std::size_t without) {
    std::vector<double> sums(batches.empty() ? 0 : batches[0].orders.size());
    double samples = 0.0;
    for (std::size_t b = 0; b < batches.size(); ++b) {
        if (b == without) continue;
        samples += batches[b].samples;
        for (std::size_t i = 0; i < sums.size(); ++i)
            sums[i] += luminanceOf(batches[b].orders[i]) * batches[b].samples;
    }
    for (double& sum : sums) sum /= samples;
    return sums;
}

double total(const std::vector<double>& energy) {
    double sum = 0.0;
    for (const double e : energy) sum += e;
    return sum;
}

/// Jackknife over batches of different sizes: Busing, Meijer, van der Leeden 1999, Delete-m Jackknife for
/// Unequal m. `estimate` is given the batch to leave out, or kEveryBatch.
template <typename Function>
Estimated jackknife(std::span<const LightBatch> batches, const Function& estimate) {
    Estimated result{estimate(kEveryBatch), -1.0};
    if (batches.size() < 2) return result;
    double samples = 0.0;
    for (const LightBatch& batch : batches) samples += batch.samples;
    const auto count = static_cast<double>(batches.size());
    std::vector<double> without(batches.size());
    double mean = count * result.value;
    for (std::size_t b = 0; b < batches.size(); ++b) {
        without[b] = estimate(b);
        mean -= (1.0 - batches[b].samples / samples) * without[b];
    }
    double variance = 0.0;
    for (std::size_t b = 0; b < batches.size(); ++b) {
        const double parts = samples / batches[b].samples;
        const double pseudo = parts * result.value - (parts - 1.0) * without[b];
        variance += (pseudo - mean) * (pseudo - mean) / (parts - 1.0);
    }
    result.standard_error = std::sqrt(variance / count);
    return result;
}

/// Steps of the series at its end that tell its ratio; the step from what is seen directly to what is lit
/// counts only where there is no other.
std::size_t ratioSteps(std::size_t orders) {
    const std::size_t steps = orders > 2 ? orders - 2 : orders - 1;
    return std::min<std::size_t>(steps, TailEstimate::kRatioSteps);
}

/// What comes behind the last order.
double geometricRest(double last, double ratio) {
    return ratio < 1.0 ? last * ratio / (1.0 - ratio) : std::numeric_limits<double>::infinity();
}

double shareOf(double part, double whole) {
    return std::isinf(part) ? 1.0 : part / whole;
}

struct Tail {
    double ratio = 0.0;
    double share = 0.0;
    double lowest = 0.0;
    double highest = 0.0;
};

std::optional<Tail> tailOf(const std::vector<double>& energy, std::size_t depth) {
    assert(depth < energy.size());
    if (energy.size() < 2 || !(total(energy) > 0.0)) return std::nullopt;
    const std::size_t last = energy.size() - 1;
    const std::size_t steps = ratioSteps(energy.size());
    Tail tail;
    double lowest = std::numeric_limits<double>::infinity();
    double highest = 0.0;
    if (energy[last] > 0.0) {
        for (std::size_t i = last - steps + 1; i <= last; ++i) {
            if (!(energy[i - 1] > 0.0)) return std::nullopt;
            lowest = std::min(lowest, energy[i] / energy[i - 1]);
            highest = std::max(highest, energy[i] / energy[i - 1]);
        }
        tail.ratio = std::pow(energy[last] / energy[last - steps], 1.0 / static_cast<double>(steps));
    } else {
        lowest = 0.0;
    }
    double followed = 0.0;  // of the tail
    for (std::size_t i = depth + 1; i <= last; ++i) followed += energy[i];
    const auto share = [&](double ratio) {
        const double rest = geometricRest(energy[last], ratio);
        return shareOf(followed + rest, total(energy) + rest);
    };
    tail.share = share(tail.ratio);
    tail.lowest = share(lowest);
    tail.highest = share(highest);
    return tail;
}

}  // namespace

double luminanceOf(const glm::dvec3& rgb) {
    return static_cast<double>(luminance(vec3(rgb)));
}

std::vector<OrderEstimate> estimateOrders(std::span<const LightBatch> batches) {
    std::vector<OrderEstimate> orders(batches.empty() ? 0 : batches[0].orders.size());
    double samples = 0.0;
    for (const LightBatch& batch : batches) {
        samples += batch.samples;
        for (std::size_t i = 0; i < orders.size(); ++i)
            orders[i].mean += batch.orders[i] * static_cast<double>(batch.samples);
    }
    for (std::size_t i = 0; i < orders.size(); ++i) {
        orders[i].mean /= samples;
        orders[i].share = jackknife(batches, [&](std::size_t without) {
            const std::vector<double> energy = energies(batches, without);
            const double all = total(energy);
            return all > 0.0 ? energy[i] / all : 0.0;
        });
    }
    return orders;
}

std::optional<TailEstimate> estimateTail(std::span<const LightBatch> batches, std::uint32_t depth) {
    const std::optional<Tail> whole = tailOf(energies(batches, kEveryBatch), depth);
    if (!whole) return std::nullopt;
    TailEstimate tail;
    tail.ratio = whole->ratio;
    tail.lowest = whole->lowest;
    tail.highest = whole->highest;
    tail.share = jackknife(batches, [&](std::size_t without) {
        const std::optional<Tail> part = tailOf(energies(batches, without), depth);
        return part ? part->share : 0.0;
    });
    return tail;
}

std::optional<std::uint32_t> depthFor(std::span<const LightBatch> batches, double error) {
    const std::vector<double> energy = energies(batches, kEveryBatch);
    if (!(total(energy) > 0.0)) return 0U;
    for (std::uint32_t depth = 0; depth < energy.size(); ++depth) {
        const std::optional<TailEstimate> tail = estimateTail(batches, depth);
        if (!tail) return std::nullopt;
        if (tail->share.value + std::max(tail->share.standard_error, 0.0) <= error) return depth;
    }
    return std::nullopt;
}

Estimated relativeDifference(std::span<const LightBatch> batches, std::span<const LightBatch> reference) {
    assert(batches.size() == reference.size());
    return jackknife(batches, [&](std::size_t without) {
        const double all = total(energies(reference, without));
        return all > 0.0 ? total(energies(batches, without)) / all - 1.0 : 0.0;
    });
}

Estimated lostShare(std::span<const LightBatch> batches, const glm::dvec3& kept) {
    return jackknife(batches, [&](std::size_t without) {
        double lost = 0.0, samples = 0.0;
        for (std::size_t b = 0; b < batches.size(); ++b) {
            if (b == without) continue;
            lost += luminanceOf(batches[b].lost) * batches[b].samples;
            samples += batches[b].samples;
        }
        lost /= samples;
        const double all = lost + luminanceOf(kept);
        return all > 0.0 ? lost / all : 0.0;
    });
}

}  // namespace licht
