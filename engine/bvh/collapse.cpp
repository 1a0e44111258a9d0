// Ylitie, Karras, Laine 2017, Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs,
// section 4: the wide tree of the least SAH cost whose nodes are nodes of the binary tree.
#include <tbb/parallel_invoke.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <array>

#include "licht/bvh/binary_tree.h"
#include "licht/bvh/encode_node.h"
#include "licht/bvh/quality.h"

namespace licht {
namespace {

constexpr std::uint32_t kTaskTriangles = 1U << 12U;  // that are worth a task of their own
// 64 bytes a node and 48 a triangle make 64 a triangle.
constexpr float kMostNodesPerTriangle = 0.25F;
constexpr int kMemoryAttempts = 8;
constexpr std::uint32_t kTaskDepth = 12;  // where sizes are not known yet, levels that make tasks

/// How a binary subtree becomes children of a wide node.
struct Plan {
    std::uint32_t triangles;   ///< in the subtree
    std::uint32_t nodes;       ///< wide nodes, if the subtree is one child; 0: a triangle
    std::uint32_t splits = 0;  ///< see split()

    static constexpr std::uint32_t kBits = 4;
    static constexpr std::uint32_t kMask = (1U << kBits) - 1;
    static_assert(kBvhWidth * kBits <= 32 && kBvhWidth <= kMask);

    /// Of `slots` children, how many the left half becomes; 0: fewer children cost less. Of kBvhWidth: when
    /// the subtree is a node.
    [[nodiscard]] std::uint32_t split(std::size_t slots) const {
        return splits >> ((slots - 1) * kBits) & kMask;
    }
    void setSplit(std::size_t slots, std::size_t left) {
        splits |= static_cast<std::uint32_t>(left) << ((slots - 1) * kBits);
    }
};

/// The least cost of a subtree as at most i + 1 children, and the wide nodes that has.
struct Costs {
    std::array<float, kBvhWidth - 1> cost;
    std::array<std::uint32_t, kBvhWidth - 1> nodes;
};

class Planner {
public:
    /// memory_cost: what a node costs for being there, whatever its area.
    Planner(std::span<const BinaryNode> binary, std::span<Plan> plans, float memory_cost)
        : binary_(binary), plans_(plans), memory_cost_(memory_cost) {}

    Costs plan(std::uint32_t index, std::uint32_t depth) const {
        const BinaryNode& node = binary_[index];
        const float area = node.halfArea();
        Costs result;
        if (node.isLeaf()) {
            plans_[index] = {1, 0};
            result.cost.fill(area * static_cast<float>(kBvhTriangleCost));
            result.nodes.fill(0);
            return result;
        }
        Costs left;
        Costs right;
        const auto planLeft = [&] { left = plan(node.left, depth + 1); };
        const auto planRight = [&] { right = plan(node.right, depth + 1); };
        if (depth < kTaskDepth) {
            tbb::parallel_invoke(planLeft, planRight);
        } else {
            planLeft();
            planRight();
        }
        Plan plan{plans_[node.left].triangles + plans_[node.right].triangles, 0};
        const Choice as_node = choose(left, right, kBvhWidth);
        plan.setSplit(kBvhWidth, as_node.left);
        plan.nodes = as_node.nodes + 1;
        result.cost[0] = as_node.cost + area * static_cast<float>(kBvhNodeCost) + memory_cost_;
        result.nodes[0] = plan.nodes;
        for (std::size_t slots = 2; slots < kBvhWidth; ++slots) {
            const Choice choice = choose(left, right, slots);
            const bool better = choice.cost < result.cost[slots - 2];
            plan.setSplit(slots, better ? choice.left : 0);
            result.cost[slots - 1] = better ? choice.cost : result.cost[slots - 2];
            result.nodes[slots - 1] = better ? choice.nodes : result.nodes[slots - 2];
        }
        plans_[index] = plan;
        return result;
    }

private:
    struct Choice {
        float cost;
        std::size_t left;
        std::uint32_t nodes;
    };

    static Choice choose(const Costs& left, const Costs& right, std::size_t slots) {
        std::size_t best = 1;
        float cost = left.cost[0] + right.cost[slots - 2];
        for (std::size_t i = 2; i < slots; ++i) {
            const float other = left.cost[i - 1] + right.cost[slots - i - 1];
            best = other < cost ? i : best;
            cost = std::min(other, cost);
        }
        return {cost, best, left.nodes[best - 1] + right.nodes[slots - best - 1]};
    }

    std::span<const BinaryNode> binary_;
    std::span<Plan> plans_;
    float memory_cost_;
};

/// What a subtree asks of a traversal.
struct Extent {
    std::uint32_t depth = 0;
    std::uint32_t stack = 0;
    double cost = 0.0;           ///< not yet relative to the root's area
    double triangle_area = 0.0;  ///< of the triangles' own boxes

    void add(const Extent& below) {
        depth = std::max(depth, below.depth);
        stack = std::max(stack, below.stack);
        cost += below.cost;
        triangle_area += below.triangle_area;
    }
};

/// Nodes below a node stand in a row: its children, then what is below the first, the second, ... Triangles:
/// its own, then those below its nodes. So every task knows where to write.
class Emitter {
public:
    Emitter(std::span<const BinaryNode> binary, std::span<const Plan> plans, Bvh& bvh)
        : binary_(binary), plans_(plans), bvh_(bvh) {}

    /// Writes the node at `index`, what is below it from `next_node` on and its triangles from
    /// `next_triangle` on. Recursion is as deep as the tree, which the builder bounds.
    Extent emit(std::uint32_t root, std::uint32_t index, std::uint32_t next_node,
                std::uint32_t next_triangle) const {
        Children children;
        std::size_t count = 0;
        if (binary_[root].isLeaf()) {
            append(root, children, count);  // the whole tree is one triangle
        } else {
            open(root, kBvhWidth, children, count);
        }
        const std::span<NodeChild> own{children.data(), count};
        arrangeChildren(own);

        Extent all{0, 0, areaOf(root) * kBvhNodeCost, 0.0};
        std::array<std::uint32_t, kBvhWidth> subtrees;
        for (std::size_t slot = 0; slot < count; ++slot) {
            NodeChild& child = own[slot];
            subtrees[slot] = child.index;
            if (!child.leaf) {
                child.index = next_node++;
                continue;
            }
            all.cost += areaOf(child.index) * kBvhTriangleCost;
            all.triangle_area += areaOf(child.index);
            bvh_.triangle_ids[next_triangle] = binary_[child.index].left;
            child.index = next_triangle++;
        }
        bvh_.nodes[index] = encodeNode(own);

        std::array<Extent, kBvhWidth> extents;
        tbb::task_group tasks;
        for (std::size_t slot = 0; slot < count && !own[slot].leaf; ++slot) {
            const Plan& plan = plans_[subtrees[slot]];
            const auto below = [=, this, &extent = extents[slot], subtree = subtrees[slot],
                                node = own[slot].index] {
                extent = emit(subtree, node, next_node, next_triangle);
            };
            if (plan.triangles >= kTaskTriangles) {
                tasks.run(below);
            } else {
                below();
            }
            next_node += plan.nodes - 1;
            next_triangle += plan.triangles;
        }
        tasks.wait();
        for (const Extent& extent : std::span(extents).first(count)) {
            all.add(extent);
        }
        ++all.depth;
        // While the most demanding child is walked, its siblings that are nodes may be waiting: as one entry.
        all.stack += count > 1 && !own[1].leaf ? 1U : 0U;
        return all;
    }

private:
    using Children = std::array<NodeChild, kBvhWidth>;

    [[nodiscard]] double areaOf(std::uint32_t index) const {
        return static_cast<double>(binary_[index].halfArea());
    }

    /// Adds a child, which is called by its binary node.
    void append(std::uint32_t index, Children& children, std::size_t& count) const {
        const BinaryNode& node = binary_[index];
        children[count++] = {node.box().bounds(), index, node.isLeaf()};
    }

    void open(std::uint32_t index, std::size_t slots, Children& children, std::size_t& count) const {
        const std::size_t left = plans_[index].split(slots);
        place(binary_[index].left, left, children, count);
        place(binary_[index].right, slots - left, children, count);
    }

    void place(std::uint32_t index, std::size_t slots, Children& children, std::size_t& count) const {
        while (slots > 1 && plans_[index].split(slots) == 0) {
            --slots;
        }
        if (slots == 1) {
            append(index, children, count);
        } else {
            open(index, slots, children, count);
        }
    }

    std::span<const BinaryNode> binary_;
    std::span<const Plan> plans_;
    Bvh& bvh_;
};

}  // namespace

void collapse(std::span<const BinaryNode> binary, Bvh& bvh) {
    if (binary.empty()) {
        bvh.nodes.push_back(encodeNode({}));
        bvh.depth = 1;
        bvh.max_stack = 1;
        return;
    }
    const Uninitialised<Plan> plans(binary.size());
    // The cheapest tree for rays, and fuller nodes where that would take too much memory.
    float memory_cost = 0.0F;
    for (int attempt = 0; attempt < kMemoryAttempts; ++attempt) {
        const Costs costs = Planner(binary, plans.span(), memory_cost).plan(0, 0);
        const auto nodes = static_cast<float>(plans[0].nodes);
        if (nodes <= kMostNodesPerTriangle * static_cast<float>(plans[0].triangles)) break;
        memory_cost = attempt == 0 ? costs.cost[0] / nodes / 8.0F : 2.0F * memory_cost;
    }
    bvh.nodes.resize(std::max(plans[0].nodes, 1U));
    bvh.triangle_ids.resize(plans[0].triangles);
    const Extent extent = Emitter(binary, plans.span(), bvh).emit(0, 0, 1, 0);
    bvh.depth = extent.depth;
    bvh.max_stack = std::max(extent.stack, 1U);
    const auto area = static_cast<double>(binary[0].halfArea());
    bvh.sah_cost = relativeTo(area, extent.cost);
    bvh.triangle_area = relativeTo(area, extent.triangle_area);
}

}  // namespace licht
