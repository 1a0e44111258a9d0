// Lauterbach et al. 2009, Fast BVH Construction on GPUs: triangles in the order of a space-filling curve, cut
// where the curve changes octants.
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_reduce.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "licht/bvh/binary_tree.h"

namespace licht {
namespace {

constexpr std::uint32_t kTaskCount = 1U << 12U;  // triangles that are worth a task of their own
constexpr std::uint32_t kIndexBits = 24;
constexpr std::uint32_t kIndexMask = (1U << kIndexBits) - 1;
constexpr std::uint32_t kAxisBits = 13;
static_assert(kBvhMostTriangles <= kIndexMask + 1 && kIndexBits + 3 * kAxisBits <= 64);

/// A bit after every two zeros, for all kAxisBits.
std::uint64_t spread(std::uint32_t cell) {
    std::uint64_t bits = 0;
    for (std::uint32_t i = 0; i < kAxisBits; ++i) {
        bits |= std::uint64_t{cell >> i & 1U} << (3 * i);
    }
    return bits;
}

const std::array<std::uint64_t, 1U << kAxisBits>& spreads() {
    static const auto table = [] {
        std::array<std::uint64_t, 1U << kAxisBits> result{};
        for (std::uint32_t cell = 0; cell < result.size(); ++cell) {
            result[cell] = spread(cell);
        }
        return result;
    }();
    return table;
}

Box centres2Of(std::span<const BuildReference> references) {
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, references.size(), kTaskCount), Box{},
        [&](const tbb::blocked_range<std::size_t>& range, Box box) {
            for (const BuildReference& reference : references.subspan(range.begin(), range.size())) {
                const Float4 centre = reference.centre2();
                box.extend({centre, centre});
            }
            return box;
        },
        [](Box a, const Box& b) {
            a.extend(b);
            return a;
        });
}

/// Above the index, the cell of each reference along the curve. No two are equal.
void makeKeys(std::span<const BuildReference> references, std::span<std::uint64_t> keys) {
    const Box centres2 = centres2Of(references);
    constexpr auto kCells = static_cast<float>(1U << kAxisBits);
    Float4 scale = four(0.0F);
    for (int axis = 0; axis < 3; ++axis) {
        const float cells_per_unit = kCells / (centres2.upper[axis] - centres2.lower[axis]);
        scale[axis] = std::isfinite(cells_per_unit) ? cells_per_unit : 0.0F;
    }
    const auto& table = spreads();
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, references.size(), kTaskCount), [&](const auto& range) {
            for (std::size_t i = range.begin(); i < range.end(); ++i) {
                const Float4 position = (references[i].centre2() - centres2.lower) * scale;
                const auto cell = [&](int axis) {
                    return table[static_cast<std::size_t>(std::min(position[axis], kCells - 1.0F))];
                };
                const std::uint64_t code = cell(0) << 2U | cell(1) << 1U | cell(2);
                keys[i] = code << kIndexBits | i;
            }
        });
}

class MortonBuilder {
public:
    MortonBuilder(std::span<const BuildReference> references, std::span<const std::uint64_t> keys,
                  std::span<BinaryNode> nodes)
        : references_(references),
          keys_(keys),
          nodes_(nodes),
          depth_limit_(binaryDepthLimit(static_cast<std::uint32_t>(references.size())) - 1) {}

    /// Nodes stand as in BinaryBuilder.
    Box build(std::uint32_t first, std::uint32_t count, std::uint32_t index, std::uint32_t depth) const {
        BinaryNode& node = nodes_[index];
        if (count == 1) {
            const BuildReference& reference = references_[keys_[first] & kIndexMask];
            node.setBox(reference);
            node.left = reference.id();
            node.right = 0;
            return reference;
        }
        const std::uint32_t in_left = split(first, count, depth);
        node.left = index + 1;
        node.right = index + 2 * in_left;
        Box left;
        Box right;
        const auto buildLeft = [&] { left = build(first, in_left, node.left, depth + 1); };
        const auto buildRight = [&] {
            right = build(first + in_left, count - in_left, node.right, depth + 1);
        };
        if (count >= kTaskCount) {
            tbb::parallel_invoke(buildLeft, buildRight);
        } else {
            buildLeft();
            buildRight();
        }
        left.extend(right);
        node.setBox(left);
        return left;
    }

private:
    /// Where the highest bit that is not the same in all keys changes; within a cell, or when the depth runs
    /// out, in the middle.
    [[nodiscard]] std::uint32_t split(std::uint32_t first, std::uint32_t count, std::uint32_t depth) const {
        const std::span<const std::uint64_t> own = keys_.subspan(first, count);
        const std::uint64_t different = (own.front() ^ own.back()) >> kIndexBits;
        const bool out_of_depth = depth + static_cast<std::uint32_t>(std::bit_width(count)) >= depth_limit_;
        if (different == 0 || out_of_depth) {
            return count / 2;
        }
        const std::uint64_t bit = std::bit_floor(different) << kIndexBits;
        const auto border = std::partition_point(own.begin(), own.end(),
                                                 [bit](std::uint64_t key) { return (key & bit) == 0; });
        return static_cast<std::uint32_t>(border - own.begin());
    }

    std::span<const BuildReference> references_;
    std::span<const std::uint64_t> keys_;
    std::span<BinaryNode> nodes_;
    std::uint32_t depth_limit_;
};

}  // namespace

void buildMorton(std::span<const BuildReference> references, std::span<BinaryNode> nodes) {
    const Uninitialised<std::uint64_t> keys(references.size());
    makeKeys(references, keys.span());
    tbb::parallel_sort(keys.span().begin(), keys.span().end());
    MortonBuilder(references, keys.span(), nodes)
        .build(0, static_cast<std::uint32_t>(references.size()), 0, 0);
}

}  // namespace licht
