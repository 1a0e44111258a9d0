#include <fmt/format.h>

#include <algorithm>

#include "licht/bvh/encode_node.h"
#include "licht/bvh/instances.h"
#include "licht/core/error.h"

namespace licht {
namespace {

/// Marks an instance among indices of nodes, which are below kBvhMostTriangles.
constexpr std::uint32_t kInstanceLeaf = 0x80000000U;

class Joiner {
public:
    /// Appends a tree whose root goes to `root` (a node that is there already) and whose other nodes follow
    /// at the end; its positions begin at `first_position`.
    void append(const std::vector<BvhNode>& nodes, std::uint32_t root, std::uint32_t first_position) {
        const auto moved_by = static_cast<std::uint32_t>(joined.nodes.size()) - 1;
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            const BvhNode moved = movedNode(nodes[i], moved_by, first_position);
            if (i == 0) {
                joined.nodes[root] = moved;
            } else {
                joined.nodes.push_back(moved);
            }
        }
    }

    /// Appends the top level. Every instance gets a node of its own with one slot: so instances wait in line
    /// as nodes do, nearest first, and their boxes are met again, shortened ray and all, before one is
    /// entered. Returns the entries that a walk of it stacks at most.
    std::uint32_t appendTop(const TwoLevelBvh& tree, const Bvh& top, std::uint32_t from, std::uint32_t to) {
        std::array<NodeChild, kBvhWidth> children;
        const std::size_t count = decodeNode(top.nodes[from], children);
        std::array<std::uint32_t, kBvhWidth> below;  // a node of `top`, or kInstanceLeaf and which leaf
        for (std::size_t i = 0; i < count; ++i) {
            if (children[i].leaf) {
                const std::uint32_t leaf = top.triangle_ids[children[i].index];
                children[i] = {tree.top_boxes[leaf], kInstanceLeaf | leaf, false};
            }
        }
        arrangeChildren({children.data(), count});
        const auto base = static_cast<std::uint32_t>(joined.nodes.size());
        for (std::size_t i = 0; i < count; ++i) {
            below[i] = children[i].index;
            children[i].index = base + static_cast<std::uint32_t>(i);
            joined.nodes.emplace_back();
        }
        joined.nodes[to] = encodeNode({children.data(), count});
        std::uint32_t most_below = 0;
        for (std::size_t i = 0; i < count; ++i) {
            if ((below[i] & kInstanceLeaf) == 0) {
                most_below = std::max(most_below, appendTop(tree, top, below[i], children[i].index));
                continue;
            }
            const std::uint32_t leaf = below[i] & ~kInstanceLeaf;
            const NodeChild only{tree.top_boxes[leaf], position(), true};
            joined.nodes[children[i].index] = encodeNode({&only, 1});
            joined.ids.push_back(tree.top_ids[leaf]);
        }
        return most_below + (count > 1 ? 1 : 0);  // the siblings wait as one group
    }

    void appendIds(std::span<const std::uint32_t> ids, std::uint32_t first) {
        for (const std::uint32_t id : ids) {
            joined.ids.push_back(first + id);
        }
    }

    [[nodiscard]] std::uint32_t position() const { return static_cast<std::uint32_t>(joined.ids.size()); }

    JoinedBvh joined;
};

/// Nodes and positions have numbers of three bytes.
void requireCounts(const TwoLevelBvh& tree, const Bvh& top) {
    // Every instance has a node of its own; above both levels there are three.
    std::uint64_t nodes = 3 + tree.baked.nodes.size() + top.nodes.size() + tree.top_ids.size();
    std::uint64_t positions = tree.baked.triangle_ids.size() + tree.top_ids.size();
    for (const Bvh& mesh : tree.meshes) {
        nodes += mesh.nodes.size();
        positions += mesh.triangle_ids.size();
    }
    if (nodes > kBvhMostTriangles || positions > kBvhMostTriangles)
        throw InputError(
            fmt::format("the scene's tree has {} nodes and {} triangles and instances, at most {} "
                        "of each can be traced",
                        nodes, positions, kBvhMostTriangles));
}

}  // namespace

JoinedBvh joinLevels(const TwoLevelBvh& tree, std::span<const std::uint32_t> triangle_counts) {
    if (tree.top.empty() && tree.meshes.empty()) {
        return {tree.baked.nodes,
                tree.baked.triangle_ids,
                {},
                {},
                static_cast<std::uint32_t>(tree.baked.triangle_ids.size()),
                tree.baked.max_stack};
    }
    Bvh top;
    collapse(tree.top, top);
    requireCounts(tree, top);

    Joiner joiner;
    JoinedBvh& joined = joiner.joined;
    const bool both = !tree.baked.triangle_ids.empty() && !tree.top.empty();
    joined.nodes.resize(both ? 3 : 1);
    const std::uint32_t baked_root = both ? 1 : 0;
    const std::uint32_t top_root = both ? 2 : 0;
    if (both) {
        const std::array<NodeChild, 2> roots{NodeChild{tree.baked.bounds, baked_root},
                                             NodeChild{tree.top_bounds, top_root}};
        joined.nodes[0] = encodeNode(roots);
    }
    joiner.append(tree.baked.nodes, baked_root, 0);
    joiner.appendIds(tree.baked.triangle_ids, 0);

    std::uint32_t first_triangle = triangle_counts[0];
    std::uint32_t most_in_mesh = 0;
    for (std::size_t m = 0; m < tree.meshes.size(); ++m) {
        const auto root = static_cast<std::uint32_t>(joined.nodes.size());
        joined.nodes.emplace_back();
        joined.roots.push_back(root);
        joined.first_triangle.push_back(first_triangle);
        joiner.append(tree.meshes[m].nodes, root, joiner.position());
        joiner.appendIds(tree.meshes[m].triangle_ids, first_triangle);
        first_triangle += triangle_counts[m + 1];
        most_in_mesh = std::max(most_in_mesh, tree.meshes[m].max_stack);
    }

    joined.first_instance_position = joiner.position();
    const std::uint32_t most_in_top = tree.top.empty() ? 0 : joiner.appendTop(tree, top, 0, top_root);
    joined.max_stack =
        std::max(tree.baked.max_stack, most_in_top + kBvhInstanceFrame + most_in_mesh) + (both ? 1 : 0);
    return joined;
}

}  // namespace licht
