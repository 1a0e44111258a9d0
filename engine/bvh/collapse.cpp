#include <algorithm>
#include <array>

#include "licht/bvh/binary_tree.h"

namespace licht {
namespace {

constexpr std::size_t kWidth = 4;

BvhNode emptyNode() {
    const vec4 lower(kInfinity);
    const vec4 upper(-kInfinity);
    return {lower, upper, lower, upper, lower, upper, uvec4(kBvhNoChild)};
}

void setChild(BvhNode& node, std::size_t slot, const Bounds& bounds, std::uint32_t child) {
    const auto i = static_cast<glm::length_t>(slot);
    node.lower_x[i] = bounds.lower.x;
    node.upper_x[i] = bounds.upper.x;
    node.lower_y[i] = bounds.lower.y;
    node.upper_y[i] = bounds.upper.y;
    node.lower_z[i] = bounds.lower.z;
    node.upper_z[i] = bounds.upper.z;
    node.child[i] = child;
}

/// What a subtree asks of a traversal.
struct Extent {
    std::uint32_t depth = 0;
    std::uint32_t stack = 0;
};

class Collapser {
public:
    Collapser(std::span<const BinaryNode> binary, std::vector<BvhNode>& nodes)
        : binary_(binary), nodes_(nodes) {}

    /// Recursion is as deep as the tree, which the builder bounds.
    Extent emit(std::uint32_t root) {
        const auto index = nodes_.size();
        nodes_.push_back(emptyNode());

        std::array<std::uint32_t, kWidth> children{root};
        std::size_t count = 1;
        while (count < kWidth) {
            const auto widest = std::max_element(
                children.begin(), children.begin() + count,
                [&](std::uint32_t a, std::uint32_t b) { return openingArea(a) < openingArea(b); });
            const std::uint32_t left = binary_[*widest].left;
            if (left == 0) {
                break;  // leaves only
            }
            *widest = left;
            children[count++] = left + 1;
        }

        Extent largest;
        for (std::size_t slot = 0; slot < count; ++slot) {
            const BinaryNode& child = binary_[children[slot]];
            if (child.left == 0) {
                setChild(nodes_[index], slot, child.bounds,
                         kBvhLeaf | child.count << kBvhCountShift | child.first);
                continue;
            }
            const auto child_index = static_cast<std::uint32_t>(nodes_.size());
            const Extent extent = emit(children[slot]);
            setChild(nodes_[index], slot, child.bounds, child_index);
            largest.depth = std::max(largest.depth, extent.depth);
            largest.stack = std::max(largest.stack, extent.stack);
        }
        // While the most demanding child is walked, all its siblings may be waiting.
        return {largest.depth + 1, largest.stack + static_cast<std::uint32_t>(count) - 1};
    }

private:
    /// Leaves cannot be opened.
    [[nodiscard]] float openingArea(std::uint32_t node) const {
        return binary_[node].left == 0 ? -1.0F : binary_[node].bounds.halfArea();
    }

    std::span<const BinaryNode> binary_;
    std::vector<BvhNode>& nodes_;
};

}  // namespace

void collapse(std::span<const BinaryNode> binary, Bvh& bvh) {
    if (binary.empty()) {
        bvh.nodes.push_back(emptyNode());
        bvh.depth = 1;
        bvh.max_stack = 1;
        return;
    }
    const Extent extent = Collapser(binary, bvh.nodes).emit(0);
    bvh.depth = extent.depth;
    bvh.max_stack = std::max(extent.stack, 1U);
}

}  // namespace licht
