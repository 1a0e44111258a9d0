#include "licht/bvh/build_split.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "licht/bvh/binary_tree.h"

namespace licht {
namespace {

constexpr std::uint32_t kMostBins = 32;
constexpr std::uint32_t kParallelCount = 1U << 16U;  // below, the two halves of a range keep the threads busy
constexpr std::uint32_t kBlock = 1U << 13U;

struct Split {
    double cost = std::numeric_limits<double>::infinity();  ///< sum of child area times count
    std::uint32_t axis = 0;
    std::uint32_t bin = 0;  ///< the first one of the right side
    Box left;
    Box right;
};

/// Maps references to bins along each axis.
struct Binning {
    Float4 lower;
    Float4 scale = four(0.0F);  ///< 0: all centres (nearly) the same along this axis
    std::uint32_t bins;

    Binning(const Box& centres2, std::uint32_t count)
        : lower(centres2.lower), bins(std::min(kMostBins, 4 + count / 16)) {
        lower[3] = 0.0F;
        for (int axis = 0; axis < 3; ++axis) {
            const float bins_per_unit =
                static_cast<float>(bins) / (centres2.upper[axis] - centres2.lower[axis]);
            scale[axis] = std::isfinite(bins_per_unit) ? bins_per_unit : 0.0F;
        }
    }
    [[nodiscard]] Float4 position(const Box& reference) const {
        return (reference.centre2() - lower) * scale;
    }
};

/// Only as many as the binning has are ever touched.
struct Bins {
    struct Planes {
        Float4 lower, upper;
    };
    std::array<std::array<Planes, kMostBins>, 3> boxes;
    std::array<std::array<std::uint32_t, kMostBins>, 3> counts;

    void clear(std::uint32_t count) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            std::fill_n(boxes[axis].begin(), count, Planes{four(kInfinity), four(-kInfinity)});
            std::fill_n(counts[axis].begin(), count, 0U);
        }
    }
    void extend(std::size_t axis, std::size_t bin, const Box& box) {
        Planes& planes = boxes[axis][bin];
        planes = {smaller(planes.lower, box.lower), larger(planes.upper, box.upper)};
    }
    [[nodiscard]] Box box(std::size_t axis, std::size_t bin) const {
        return {boxes[axis][bin].lower, boxes[axis][bin].upper};
    }
};

void put(Bins& bins, const BuildReference& reference, const Binning& binning) {
    const Float4 last = four(static_cast<float>(binning.bins - 1));
    const Int4 bin = __builtin_convertvector(smaller(binning.position(reference), last), Int4);
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const auto b = static_cast<std::size_t>(bin[axis]);
        bins.extend(a, b, reference);
        ++bins.counts[a][b];
    }
}

/// Neighbours often share a bin, and would wait for each other: two ends take turns.
void fill(Bins& bins, std::span<const BuildReference> references, const Binning& binning) {
    bins.clear(binning.bins);
    const std::size_t half = references.size() / 2;
    for (std::size_t i = 0; i < half; ++i) {
        put(bins, references[i], binning);
        put(bins, references[half + i], binning);
    }
    if (references.size() % 2 != 0) {
        put(bins, references.back(), binning);
    }
}

void merge(Bins& into, const Bins& from, std::uint32_t count) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t bin = 0; bin < count; ++bin) {
            into.extend(axis, bin, from.box(axis, bin));
            into.counts[axis][bin] += from.counts[axis][bin];
        }
    }
}

Split bestSplit(const Bins& bins, const Binning& binning) {
    Split best;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
        if (binning.scale[static_cast<int>(axis)] == 0.0F) {
            continue;
        }
        const auto& counts = bins.counts[axis];
        std::array<double, kMostBins> right_cost;
        std::array<Box, kMostBins> rights;
        Box right;
        std::uint32_t count = 0;
        for (std::uint32_t i = binning.bins - 1; i > 0; --i) {
            right.extend(bins.box(axis, i));
            count += counts[i];
            rights[i] = right;
            right_cost[i] = count > 0 ? static_cast<double>(right.halfArea()) * count : best.cost;
        }
        Box left;
        count = 0;
        for (std::uint32_t i = 1; i < binning.bins; ++i) {
            left.extend(bins.box(axis, i - 1));
            count += counts[i - 1];
            const double cost =
                count > 0 ? static_cast<double>(left.halfArea()) * count + right_cost[i] : best.cost;
            if (cost < best.cost) {
                best = {cost, axis, i, left, rights[i]};
            }
        }
    }
    return best;
}

/// Where the halves of a part of a range go.
struct Targets {
    BuildReference* right;
    BuildReference* left;
};

/// Moves references to their halves; the left one may be where they come from. Without branches: none could
/// be foretold.
void distribute(std::span<const BuildReference> references, const Binning& binning, const Split& split,
                Targets& targets) {
    const auto axis = static_cast<int>(split.axis);
    const float lower = binning.lower[axis];
    const float scale = binning.scale[axis];
    const auto border = static_cast<float>(split.bin);
    std::array<BuildReference*, 2> next{targets.right, targets.left};
    for (const BuildReference& reference : references) {
        const BuildReference moved = reference;
        const bool left = (moved.lower[axis] + moved.upper[axis] - lower) * scale < border;
        *next[left ? 1 : 0]++ = moved;
    }
    targets = {next[0], next[1]};
}

Box centres2Of(std::span<const BuildReference> references) {
    Box box;
    for (const BuildReference& reference : references) {
        const Float4 centre = reference.centre2();
        box.extend({centre, centre});
    }
    return box;
}

/// Of references that nothing tells apart: any order is as good as another.
BuildHalves cutInOrder(const BuildBuffers& buffers, const BuildRange& range) {
    const std::uint32_t left = range.count / 2;
    const std::span<const BuildReference> own{buffers.references + range.first, range.count};
    return {measureRange(own.first(left), range.first), measureRange(own.subspan(left), range.first + left)};
}

BuildHalves cutAt(const BuildRange& range, std::uint32_t left, const Split& split) {
    return {{range.first, left, split.left}, {range.first + left, range.count - left, split.right}};
}

BuildHalves splitAlone(const BuildBuffers& buffers, const BuildRange& range) {
    const std::span<BuildReference> own{buffers.references + range.first, range.count};
    const Binning binning(centres2Of(own), range.count);
    Bins bins;
    fill(bins, own, binning);
    const Split split = bestSplit(bins, binning);
    if (split.bin == 0) {
        return cutInOrder(buffers, range);
    }
    BuildReference* const aside = buffers.scratch + range.first;
    Targets targets{aside, own.data()};
    distribute(own, binning, split, targets);
    std::copy(aside, targets.right, targets.left);
    return cutAt(range, static_cast<std::uint32_t>(targets.left - own.data()), split);
}

BuildHalves splitTogether(BuildBuffers& buffers, const BuildRange& range) {
    const std::span<BuildReference> own{buffers.references + range.first, range.count};
    const std::uint32_t blocks = (range.count + kBlock - 1) / kBlock;
    const auto block = [&](std::uint32_t i) {
        return own.subspan(std::size_t{i} * kBlock, std::min(kBlock, range.count - i * kBlock));
    };
    std::vector<Box> centres2(blocks);
    tbb::parallel_for(0U, blocks, [&](std::uint32_t i) { centres2[i] = centres2Of(block(i)); });
    Box all_centres2;
    for (const Box& part : centres2) {
        all_centres2.extend(part);
    }
    const Binning binning(all_centres2, range.count);

    const Uninitialised<Bins> bins(blocks);
    tbb::parallel_for(0U, blocks, [&](std::uint32_t i) { fill(bins[i], block(i), binning); });
    Bins sum;
    sum.clear(binning.bins);
    for (const Bins& part : bins.span()) {
        merge(sum, part, binning.bins);
    }
    const Split split = bestSplit(sum, binning);
    if (split.bin == 0) {
        return cutInOrder(buffers, range);
    }
    const auto leftOf = [&](const Bins& part) {
        const auto& counts = part.counts[split.axis];
        return std::accumulate(counts.begin(), counts.begin() + split.bin, 0U);
    };
    const BuildHalves halves = cutAt(range, leftOf(sum), split);
    std::vector<Targets> targets(blocks);
    Targets next{buffers.scratch + halves.right.first, buffers.scratch + halves.left.first};
    for (std::uint32_t i = 0; i < blocks; ++i) {
        targets[i] = next;
        const std::uint32_t left = leftOf(bins[i]);
        next.left += left;
        next.right += block(i).size() - left;
    }
    tbb::parallel_for(0U, blocks, [&](std::uint32_t i) { distribute(block(i), binning, split, targets[i]); });
    std::swap(buffers.references, buffers.scratch);
    return halves;
}

}  // namespace

BuildRange measureRange(std::span<const BuildReference> references, std::uint32_t first) {
    BuildRange range{first, static_cast<std::uint32_t>(references.size()), {}};
    for (const BuildReference& reference : references) {
        range.bounds.extend(reference);
    }
    return range;
}

BuildHalves splitBinned(BuildBuffers& buffers, const BuildRange& range) {
    return range.count >= kParallelCount ? splitTogether(buffers, range) : splitAlone(buffers, range);
}

BuildHalves splitMiddle(BuildBuffers& buffers, const BuildRange& range) {
    BuildReference* const own = buffers.references + range.first;
    const Box centres2 = centres2Of({own, range.count});
    const Float4 size = centres2.upper - centres2.lower;
    const int axis = size[0] >= size[1] && size[0] >= size[2] ? 0 : (size[1] >= size[2] ? 1 : 2);
    const auto before = [axis](const BuildReference& a, const BuildReference& b) {
        const float position_a = a.lower[axis] + a.upper[axis];
        const float position_b = b.lower[axis] + b.upper[axis];
        return position_a < position_b || (position_a == position_b && a.id() < b.id());
    };
    std::nth_element(own, own + range.count / 2, own + range.count, before);
    return cutInOrder(buffers, range);
}

}  // namespace licht
