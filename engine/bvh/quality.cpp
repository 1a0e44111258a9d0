#include "licht/bvh/quality.h"

#include "licht/bvh/encode_node.h"

namespace licht {

double sahCost(const Bvh& bvh) {
    const auto root = static_cast<double>(bvh.bounds.halfArea());
    double cost = root * kBvhNodeCost;
    std::array<NodeChild, kBvhWidth> children;
    for (const BvhNode& node : bvh.nodes) {
        const std::size_t count = decodeNode(node, children);
        for (const NodeChild& child : std::span(children).first(count)) {
            cost +=
                static_cast<double>(child.bounds.halfArea()) * (child.leaf ? kBvhTriangleCost : kBvhNodeCost);
        }
    }
    return relativeTo(root, cost);
}

}  // namespace licht
