#include "licht/bvh/refit.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <array>
#include <functional>
#include <string>

#include "licht/bvh/encode_node.h"
#include "licht/bvh/quality.h"
#include "licht/bvh/ray_setup.h"
#include "licht/core/error.h"

namespace licht {
namespace {

constexpr std::uint32_t kTaskDepth = 5;  // levels of wide nodes that make tasks

struct Subtree {
    Bounds bounds;
    double cost = 0.0;           ///< not yet relative to the root's area
    double triangle_area = 0.0;  ///< of the triangles' own boxes
    std::uint32_t usable = 0;

    void add(const Subtree& other) {
        bounds.extend(other.bounds);
        cost += other.cost;
        triangle_area += other.triangle_area;
        usable += other.usable;
    }
};

double areaOf(const Bounds& bounds) {
    return static_cast<double>(bounds.halfArea());
}

class Refitter {
public:
    Refitter(Bvh& bvh, std::span<const BvhTriangle> triangles) : bvh_(bvh), triangles_(triangles) {}

    /// Recursion is as deep as the tree, which the builder bounds.
    Subtree refit(std::uint32_t index, std::uint32_t depth) const {
        std::array<NodeChild, kBvhWidth> children;
        const std::size_t count = decodeNode(bvh_.nodes[index], children);
        std::array<Subtree, kBvhWidth> below;
        tbb::task_group tasks;
        for (std::size_t slot = 0; slot < count; ++slot) {
            const NodeChild& child = children[slot];
            if (child.leaf) {
                below[slot] = refitTriangle(bvh_.triangle_ids[child.index]);
            } else if (depth < kTaskDepth) {
                tasks.run([=, this, &subtree = below[slot], index_below = child.index] {
                    subtree = refit(index_below, depth + 1);
                });
            } else {
                below[slot] = refit(child.index, depth + 1);
            }
        }
        tasks.wait();
        Subtree all;
        for (std::size_t slot = 0; slot < count; ++slot) {
            children[slot].bounds = below[slot].bounds;
            all.add(below[slot]);
        }
        bvh_.nodes[index] = encodeNode({children.data(), count});
        all.cost += areaOf(all.bounds) * kBvhNodeCost;
        return all;
    }

private:
    [[nodiscard]] Subtree refitTriangle(std::uint32_t id) const {
        if (!isUsable(triangles_[id])) {
            return {};
        }
        const Bounds bounds = boundsOf(triangles_[id]);
        const double area = areaOf(bounds);
        return {bounds, area * kBvhTriangleCost, area, 1};
    }

    Bvh& bvh_;
    std::span<const BvhTriangle> triangles_;
};

std::uint32_t countUsable(std::span<const BvhTriangle> triangles) {
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, triangles.size(), 4096), 0U,
        [&](const tbb::blocked_range<std::size_t>& range, std::uint32_t count) {
            const auto own = triangles.subspan(range.begin(), range.size());
            return count + static_cast<std::uint32_t>(std::count_if(own.begin(), own.end(), isUsable));
        },
        std::plus<>());
}

double growth(double before, double now) {
    return before > 0.0 ? now / before : 1.0;
}

}  // namespace

RefitResult refitBvh(Bvh& bvh, std::span<const BvhTriangle> triangles) {
    if (triangles.size() != bvh.input_triangles) {
        throw InputError("a tree over " + std::to_string(bvh.input_triangles) +
                         " triangles cannot be fitted to " + std::to_string(triangles.size()));
    }
    const Subtree tree = Refitter(bvh, triangles).refit(0, 0);
    bvh.bounds = tree.bounds;
    bvh.dropped = bvh.input_triangles - tree.usable;
    if (tree.usable == 0) {
        bvh.nodes[0] = encodeNode({});
    }
    const double area = areaOf(tree.bounds);
    RefitResult result;
    result.sah_cost = relativeTo(area, tree.cost);
    result.loss = std::max(
        growth(bvh.sah_cost, result.sah_cost),
        growth(relativeTo(bvh.triangle_area, bvh.sah_cost), relativeTo(tree.triangle_area, tree.cost)));
    result.missing = countUsable(triangles) - tree.usable;
    return result;
}

bool wantsRebuild(const RefitResult& result) {
    return result.missing > 0 || result.loss > kMostRefitLoss;
}

}  // namespace licht
