#include "licht/scene/gltf_origin.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace licht::gltf {
namespace {

/// Of its radii: a scene whose centre is farther from the origin than that is moved. It has then lost four of
/// the 24 bits of its floats' significands.
constexpr double kFar = 16.0;

/// What the stored numbers of normalised components are divided by (glTF 2.0, 3.6.2.2).
double divisorOf(const tinygltf::Accessor& accessor) {
    if (!accessor.normalized) return 1.0;
    switch (accessor.componentType) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return 127.0;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 255.0;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return 32767.0;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 65535.0;
        default:
            return 1.0;
    }
}

struct Box {
    glm::dvec3 lower{INFINITY};
    glm::dvec3 upper{-INFINITY};

    void extend(const glm::dvec3& point) {
        lower = glm::min(lower, point);
        upper = glm::max(upper, point);
    }
};

/// What an accessor states of its positions.
std::optional<Box> statedBounds(const Asset& asset, const tinygltf::Primitive& primitive) {
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end() || position->second < 0 ||
        static_cast<std::size_t>(position->second) >= asset.model.accessors.size())
        return std::nullopt;
    const tinygltf::Accessor& accessor = asset.model.accessors[static_cast<std::size_t>(position->second)];
    if (accessor.minValues.size() != 3 || accessor.maxValues.size() != 3) return std::nullopt;
    const double divisor = divisorOf(accessor);
    Box box;
    for (const std::vector<double>* values : {&accessor.minValues, &accessor.maxValues})
        box.extend(glm::dvec3((*values)[0], (*values)[1], (*values)[2]) / divisor);
    return box;
}

void extendBy(Box& world, const Box& box, const glm::dmat4& world_from_box) {
    for (unsigned corner = 0; corner < 8; ++corner)
        world.extend(
            glm::dvec3(world_from_box * glm::dvec4((corner & 1U) != 0 ? box.upper.x : box.lower.x,
                                                   (corner & 2U) != 0 ? box.upper.y : box.lower.y,
                                                   (corner & 4U) != 0 ? box.upper.z : box.lower.z, 1.0)));
}

/// A skinned mesh stands where its joints are; of others the node places what its accessors state.
void extendBy(Box& world, const Asset& asset, const NodeTree& tree, int node) {
    const auto index = static_cast<std::size_t>(node);
    const tinygltf::Node& source = asset.model.nodes[index];
    if (source.mesh < 0 || static_cast<std::size_t>(source.mesh) >= asset.model.meshes.size()) return;
    const auto& skins = asset.model.skins;
    if (source.skin >= 0 && static_cast<std::size_t>(source.skin) < skins.size()) {
        for (const int joint : skins[static_cast<std::size_t>(source.skin)].joints)
            if (joint >= 0 && static_cast<std::size_t>(joint) < tree.world_from_node.size())
                world.extend(glm::dvec3(tree.world_from_node[static_cast<std::size_t>(joint)][3]));
        return;
    }
    for (const tinygltf::Primitive& primitive :
         asset.model.meshes[static_cast<std::size_t>(source.mesh)].primitives)
        if (const std::optional<Box> box = statedBounds(asset, primitive))
            extendBy(world, *box, tree.world_from_node[index]);
        else
            world.extend(glm::dvec3(tree.world_from_node[index][3]));
}

}  // namespace

glm::dvec3 moveToOrigin(const Asset& asset, NodeTree& tree) {
    Box world;
    for (const int node : tree.visible) extendBy(world, asset, tree, node);
    const glm::dvec3 centre = 0.5 * (world.lower + world.upper);
    const double radius = 0.5 * glm::length(world.upper - world.lower);
    const double distance = std::max({std::abs(centre.x), std::abs(centre.y), std::abs(centre.z)});
    // Not finite: nothing is visible, or what is there will be refused where it is met.
    if (!std::isfinite(distance) || !std::isfinite(radius) || !(distance > kFar * radius) || distance < kFar)
        return glm::dvec3(0.0);
    const double step = std::exp2(std::floor(std::log2(std::max(radius, distance * 0x1p-40))));
    const glm::dvec3 origin = step * glm::round(centre / step);
    for (glm::dmat4& world_from_node : tree.world_from_node) world_from_node[3] -= glm::dvec4(origin, 0.0);
    return origin;
}

}  // namespace licht::gltf
