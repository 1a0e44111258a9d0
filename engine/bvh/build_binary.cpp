#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <bit>

#include "licht/bvh/binary_tree.h"
#include "licht/bvh/build_split.h"

namespace licht {
namespace {

constexpr std::uint32_t kTaskCount = 1U << 12U;  // triangles that are worth a task of their own
constexpr std::uint32_t kSweepCount = 4;         // up to here every split is tried
constexpr std::uint32_t kSpareLevels = 8;        // that the heuristic may spend beyond 2 log2(n)

std::uint32_t ceilLog2(std::uint32_t n) {
    return static_cast<std::uint32_t>(std::bit_width(n - 1U));
}

/// The nodes of n triangles are 2 n - 1 in a row: a node, those of its left half, those of its right half. So
/// every task knows where to write, and the order is that of a walk.
class BinaryBuilder {
public:
    BinaryBuilder(std::span<BinaryNode> nodes, std::uint32_t triangles)
        : nodes_(nodes), depth_limit_(binaryDepthLimit(triangles) - 1) {}

    void build(BuildBuffers buffers, const BuildRange& range, std::uint32_t node, std::uint32_t depth) {
        if (range.count <= kSweepCount) {
            sweep({buffers.references + range.first, range.count}, range.bounds, node);
            return;
        }
        // Sweeping the last few adds at most kSweepCount - 1 levels.
        const bool out_of_depth = depth + ceilLog2(range.count) + kSweepCount > depth_limit_;
        const BuildHalves halves = out_of_depth ? splitMiddle(buffers, range) : splitBinned(buffers, range);
        const std::uint32_t left = node + 1;
        const std::uint32_t right = node + 2 * halves.left.count;
        write(node, range.bounds, left, right);
        const auto buildLeft = [&] { build(buffers, halves.left, left, depth + 1); };
        const auto buildRight = [&] { build(buffers, halves.right, right, depth + 1); };
        if (range.count >= kTaskCount) {
            tbb::parallel_invoke(buildLeft, buildRight);
        } else {
            buildLeft();
            buildRight();
        }
    }

private:
    void write(std::uint32_t node, const Box& box, std::uint32_t left, std::uint32_t right) {
        nodes_[node].setBox(box);
        nodes_[node].left = left;
        nodes_[node].right = right;
    }

    /// The best of all splits along each axis.
    void sweep(std::span<BuildReference> references, const Box& bounds, std::uint32_t node) {
        const std::size_t count = references.size();
        if (count == 1) {
            write(node, references[0], references[0].id(), 0);
            return;
        }
        using Order = std::array<std::uint8_t, kSweepCount>;
        Order best_order{0, 1};
        std::size_t best_left = 1;
        Box best_left_box = references[0];
        Box best_right_box = references[1];
        if (count > 2) {
            double best_cost = std::numeric_limits<double>::infinity();
            for (int axis = 0; axis < 3; ++axis) {
                const Order order = sorted(references, axis);
                std::array<Box, kSweepCount> rights;
                rights[count - 1] = references[order[count - 1]];
                for (std::size_t i = count - 1; i-- > 1;) {
                    rights[i] = rights[i + 1];
                    rights[i].extend(references[order[i]]);
                }
                Box left;
                for (std::size_t i = 1; i < count; ++i) {
                    left.extend(references[order[i - 1]]);
                    const double cost =
                        static_cast<double>(left.halfArea()) * static_cast<double>(i) +
                        static_cast<double>(rights[i].halfArea()) * static_cast<double>(count - i);
                    if (cost < best_cost) {
                        best_cost = cost;
                        best_order = order;
                        best_left = i;
                        best_left_box = left;
                        best_right_box = rights[i];
                    }
                }
            }
            std::array<BuildReference, kSweepCount> copy;
            std::copy(references.begin(), references.end(), copy.begin());
            for (std::size_t i = 0; i < count; ++i) {
                references[i] = copy[best_order[i]];
            }
        }
        const std::uint32_t left = node + 1;
        const std::uint32_t right = node + 2 * static_cast<std::uint32_t>(best_left);
        write(node, bounds, left, right);
        sweep(references.first(best_left), best_left_box, left);
        sweep(references.subspan(best_left), best_right_box, right);
    }

    /// Insertion sort by centre; equal ones stay in order.
    static std::array<std::uint8_t, kSweepCount> sorted(std::span<const BuildReference> references,
                                                        int axis) {
        std::array<std::uint8_t, kSweepCount> order{};
        std::array<float, kSweepCount> keys;
        for (std::size_t i = 0; i < references.size(); ++i) {
            const float key = references[i].lower[axis] + references[i].upper[axis];
            std::size_t at = i;
            for (; at > 0 && key < keys[at - 1]; --at) {
                keys[at] = keys[at - 1];
                order[at] = order[at - 1];
            }
            keys[at] = key;
            order[at] = static_cast<std::uint8_t>(i);
        }
        return order;
    }

    std::span<BinaryNode> nodes_;
    std::uint32_t depth_limit_;
};

}  // namespace

std::uint32_t binaryDepthLimit(std::uint32_t triangles) {
    return 2 * ceilLog2(triangles) + kSpareLevels + 1;
}

void buildBinary(std::span<BuildReference> references, std::span<BuildReference> scratch,
                 std::span<BinaryNode> nodes) {
    const auto count = static_cast<std::uint32_t>(references.size());
    BinaryBuilder(nodes, count).build({references.data(), scratch.data()}, measureRange(references, 0), 0, 0);
}

std::vector<BinaryNode> buildBinary(std::span<const Bounds> boxes) {
    if (boxes.empty()) {
        return {};
    }
    std::vector<BuildReference> references;
    references.reserve(boxes.size());
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        references.emplace_back(boxes[i], i);
    }
    std::vector<BuildReference> scratch(boxes.size());
    std::vector<BinaryNode> nodes(2 * boxes.size() - 1);
    buildBinary(references, scratch, nodes);
    return nodes;
}

}  // namespace licht
