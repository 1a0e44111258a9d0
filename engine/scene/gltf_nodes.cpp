#include "licht/scene/gltf_nodes.h"

#include <fmt/format.h>

#include <algorithm>

namespace licht::gltf {
namespace {

std::string nameOf(const Asset& asset, std::size_t node) {
    return objectName("node", node, asset.model.nodes[node].name);
}

void checkLength(const Asset& asset, std::size_t node, const std::vector<double>& values, std::size_t wanted,
                 std::string_view what) {
    if (!values.empty() && values.size() != wanted) {
        asset.fail(nameOf(asset, node),
                   fmt::format("its {} has {} numbers, {} are wanted", what, values.size(), wanted));
    }
}

glm::dmat4 localTransform(Asset& asset, std::size_t index) {
    const tinygltf::Node& node = asset.model.nodes[index];
    checkLength(asset, index, node.matrix, 16, "matrix");
    checkLength(asset, index, node.translation, 3, "translation");
    checkLength(asset, index, node.rotation, 4, "rotation");
    checkLength(asset, index, node.scale, 3, "scale");
    if (!node.matrix.empty()) {
        glm::dmat4 matrix;
        for (int column = 0; column < 4; ++column) {
            for (int row = 0; row < 4; ++row) {
                matrix[column][row] = node.matrix[static_cast<std::size_t>(4 * column + row)];
            }
        }
        return matrix;
    }
    glm::dmat4 local(1.0);
    if (!node.rotation.empty()) {
        const glm::dquat q(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
        const double length = glm::length(q);
        if (length > 0.0 && std::isfinite(length)) {
            local = glm::mat4_cast(q / length);
        } else {
            asset.warn(fmt::format("{}: its rotation is no quaternion with a direction and taken as none",
                                   nameOf(asset, index)));
        }
    }
    if (!node.scale.empty()) {
        for (int axis = 0; axis < 3; ++axis) {
            local[axis] *= node.scale[static_cast<std::size_t>(axis)];
        }
    }
    if (!node.translation.empty()) {
        local[3] = glm::dvec4(node.translation[0], node.translation[1], node.translation[2], 1.0);
    }
    return local;
}

/// The parent of every node, -1 for roots.
std::vector<int> parents(const Asset& asset) {
    const std::vector<tinygltf::Node>& nodes = asset.model.nodes;
    std::vector<int> parent(nodes.size(), -1);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        for (const int child : nodes[i].children) {
            at(asset, nodes, child, nameOf(asset, i), "child node");
            int& known = parent[static_cast<std::size_t>(child)];
            if (known != -1) {
                asset.fail(nameOf(asset, static_cast<std::size_t>(child)),
                           fmt::format("it has two parents, nodes {} and {}", known, i));
            }
            known = static_cast<int>(i);
        }
    }
    return parent;
}

/// Everything below the given roots, parents before children. Every node has one parent at most, so none
/// comes twice.
std::vector<int> below(const Asset& asset, const std::vector<int>& roots) {
    std::vector<int> order(roots);
    for (std::size_t i = 0; i < order.size(); ++i) {
        const std::vector<int>& children = asset.model.nodes[static_cast<std::size_t>(order[i])].children;
        order.insert(order.end(), children.begin(), children.end());
    }
    return order;
}

std::vector<int> rootsOf(const Asset& asset, std::optional<std::uint32_t> scene_index,
                         const std::vector<int>& parent, const std::vector<int>& all_roots) {
    const std::vector<tinygltf::Scene>& scenes = asset.model.scenes;
    if (scenes.empty() && !scene_index) {
        return all_roots;
    }
    const int wanted = scene_index ? static_cast<int>(std::min(*scene_index, std::uint32_t{INT32_MAX}))
                                   : std::max(asset.model.defaultScene, 0);
    const tinygltf::Scene& scene =
        at(asset, scenes, wanted, scene_index ? "the scene asked for" : "the default scene", "scene");
    const std::string name = objectName("scene", static_cast<std::size_t>(wanted), scene.name);
    std::vector<bool> seen(asset.model.nodes.size());
    for (const int node : scene.nodes) {
        at(asset, asset.model.nodes, node, name, "node");
        const auto index = static_cast<std::size_t>(node);
        if (parent[index] != -1) {
            asset.fail(name, fmt::format("node {} is no root, its parent is node {}", node, parent[index]));
        }
        if (seen[index]) {
            asset.fail(name, fmt::format("node {} is listed twice", node));
        }
        seen[index] = true;
    }
    return scene.nodes;
}

}  // namespace

NodeTree flattenNodes(Asset& asset, std::optional<std::uint32_t> scene_index) {
    const std::vector<int> parent = parents(asset);
    std::vector<int> roots;
    for (std::size_t i = 0; i < parent.size(); ++i) {
        if (parent[i] == -1) {
            roots.push_back(static_cast<int>(i));
        }
    }
    const std::vector<int> order = below(asset, roots);
    if (order.size() < parent.size()) {
        // What no root leads to hangs on a cycle.
        std::vector<bool> reached(parent.size());
        for (const int node : order) {
            reached[static_cast<std::size_t>(node)] = true;
        }
        const auto lost =
            static_cast<std::size_t>(std::find(reached.begin(), reached.end(), false) - reached.begin());
        asset.fail(nameOf(asset, lost), "it belongs to a cycle of nodes");
    }
    NodeTree tree;
    tree.world_from_node.assign(parent.size(), glm::dmat4(1.0));
    for (const int node : order) {
        const auto i = static_cast<std::size_t>(node);
        const glm::dmat4 local = localTransform(asset, i);
        tree.world_from_node[i] =
            parent[i] == -1 ? local : tree.world_from_node[static_cast<std::size_t>(parent[i])] * local;
    }
    tree.visible = below(asset, rootsOf(asset, scene_index, parent, roots));
    return tree;
}

}  // namespace licht::gltf
