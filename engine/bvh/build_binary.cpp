// Wald 2007, On fast Construction of SAH-based Bounding Volume Hierarchies.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "licht/bvh/binary_tree.h"

namespace licht {
namespace {

constexpr int kBins = 16;
constexpr double kNodeCost = 1.0;          // of one binary step; a triangle test costs 1
constexpr std::uint32_t kSpareLevels = 8;  // that the heuristic may spend beyond 2 log2(n)

struct Bin {
    Bounds bounds;
    std::uint32_t count = 0;
};

struct Split {
    double cost = std::numeric_limits<double>::infinity();  ///< sum of child area times count
    int axis = 0;
    int bin = 0;  ///< the first one of the right side
};

/// Maps twice the centroid of a reference to its bin, along each axis.
struct Binning {
    vec3 lower;
    vec3 scale;  ///< 0: all centroids (nearly) the same along this axis

    explicit Binning(const Bounds& centroids) : lower(centroids.lower), scale(0.0F) {
        const vec3 size = centroids.size();
        for (int axis = 0; axis < 3; ++axis) {
            const float bins_per_unit = static_cast<float>(kBins) / size[axis];
            scale[axis] = std::isfinite(bins_per_unit) ? bins_per_unit : 0.0F;
        }
    }
    [[nodiscard]] int bin(const BuildReference& reference, int axis) const {
        const float position = (reference.lower[axis] + reference.upper[axis] - lower[axis]) * scale[axis];
        return std::min(static_cast<int>(position), kBins - 1);
    }
};

Bounds centroidBounds(std::span<const BuildReference> references) {
    Bounds bounds;
    for (const BuildReference& reference : references) {
        bounds.extend(reference.lower + reference.upper);
    }
    return bounds;
}

Bounds boundsOf(std::span<const BuildReference> references) {
    Bounds bounds;
    for (const BuildReference& reference : references) {
        bounds.extend(Bounds{reference.lower, reference.upper});
    }
    return bounds;
}

double weightedArea(const Bin& side) {
    return static_cast<double>(side.bounds.halfArea()) * side.count;
}

void add(Bin& sum, const Bin& bin) {
    sum.bounds.extend(bin.bounds);
    sum.count += bin.count;
}

Split findSplit(std::span<const BuildReference> references, const Binning& binning) {
    std::array<std::array<Bin, kBins>, 3> bins;
    for (const BuildReference& reference : references) {
        for (int axis = 0; axis < 3; ++axis) {
            Bin& bin =
                bins[static_cast<std::size_t>(axis)][static_cast<std::size_t>(binning.bin(reference, axis))];
            bin.bounds.extend(Bounds{reference.lower, reference.upper});
            ++bin.count;
        }
    }
    Split best;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::array<double, kBins> right_cost{};
        Bin right;
        for (std::size_t i = kBins - 1; i > 0; --i) {
            add(right, bins[axis][i]);
            right_cost[i] = right.count > 0 ? weightedArea(right) : std::numeric_limits<double>::infinity();
        }
        Bin left;
        for (std::size_t i = 1; i < kBins; ++i) {
            add(left, bins[axis][i - 1]);
            const double cost = left.count > 0 ? weightedArea(left) + right_cost[i] : best.cost;
            if (cost < best.cost) {
                best = {cost, static_cast<int>(axis), static_cast<int>(i)};
            }
        }
    }
    return best;
}

/// How many references go left; 0: make a leaf.
std::uint32_t divide(std::span<BuildReference> references, const Bounds& bounds, bool halve) {
    const auto count = static_cast<std::uint32_t>(references.size());
    if (count == 1) {
        return 0;
    }
    const Bounds centroids = centroidBounds(references);
    if (halve) {
        const vec3 size = centroids.size();
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
        const auto before = [axis](const BuildReference& a, const BuildReference& b) {
            const float position_a = a.lower[axis] + a.upper[axis];
            const float position_b = b.lower[axis] + b.upper[axis];
            return position_a < position_b || (position_a == position_b && a.id < b.id);
        };
        std::nth_element(references.begin(), references.begin() + count / 2, references.end(), before);
        return count / 2;
    }
    const Binning binning(centroids);
    const Split split = findSplit(references, binning);
    const auto area = static_cast<double>(bounds.halfArea());
    if (count <= kBvhMaxLeaf && area * count <= kNodeCost * area + split.cost) {
        return 0;
    }
    if (!std::isfinite(split.cost)) {
        return count / 2;  // identical centroids: any order is as good as another
    }
    const auto middle = std::partition(
        references.begin(), references.end(),
        [&](const BuildReference& reference) { return binning.bin(reference, split.axis) < split.bin; });
    return static_cast<std::uint32_t>(middle - references.begin());
}

}  // namespace

std::vector<BinaryNode> buildBinary(std::span<BuildReference> references) {
    const auto ceilLog2 = [](std::uint32_t n) { return static_cast<std::uint32_t>(std::bit_width(n - 1U)); };
    const auto total = static_cast<std::uint32_t>(references.size());
    const std::uint32_t depth_limit = 2 * ceilLog2(total) + kSpareLevels;

    struct Task {
        std::uint32_t node;
        std::uint32_t depth;
    };
    std::vector<BinaryNode> nodes{{boundsOf(references), 0, total, 0}};
    std::vector<Task> tasks{{0, 0}};
    while (!tasks.empty()) {
        const Task task = tasks.back();
        tasks.pop_back();
        const BinaryNode node = nodes[task.node];
        const auto own = references.subspan(node.first, node.count);
        const std::uint32_t left = divide(own, node.bounds, task.depth + ceilLog2(node.count) >= depth_limit);
        if (left == 0) {
            continue;
        }
        const auto child = static_cast<std::uint32_t>(nodes.size());
        nodes[task.node].left = child;
        nodes.push_back({boundsOf(own.first(left)), node.first, left, 0});
        nodes.push_back({boundsOf(own.subspan(left)), node.first + left, node.count - left, 0});
        tasks.push_back({child + 1, task.depth + 1});
        tasks.push_back({child, task.depth + 1});
    }
    return nodes;
}

}  // namespace licht
