#include "licht/scene/gltf.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <utility>

#include "licht/scene/coarse_places.h"
#include "licht/scene/gltf_accessor.h"
#include "licht/scene/gltf_asset.h"
#include "licht/scene/gltf_budget.h"
#include "licht/scene/gltf_geometry.h"
#include "licht/scene/gltf_instancing.h"
#include "licht/scene/gltf_material.h"
#include "licht/scene/gltf_nodes.h"
#include "licht/scene/gltf_origin.h"
#include "licht/scene/gltf_views.h"

namespace licht {
namespace gltf {
namespace {

/// Why a transform cannot place a mesh; empty when it can.
std::string_view placementFault(const mat4& world_from_object) {
    const glm::dmat4 m(world_from_object);
    for (int column = 0; column < 4; ++column) {
        if (!isPlace(vec3(world_from_object[column]))) {
            return "its transform is not finite or too large";
        }
    }
    if (m[0][3] != 0.0 || m[1][3] != 0.0 || m[2][3] != 0.0 || m[3][3] != 1.0) {
        return "its transform is not affine";
    }
    return glm::determinant(glm::dmat3(m)) == 0.0
               ? "its transform flattens it (a scale or matrix that is singular)"
               : "";
}

/// Walks the visible nodes and fills the scene.
class SceneBuilder {
public:
    SceneBuilder(Asset& asset, NodeTree tree)
        : asset_(asset), tree_(std::move(tree)), materials_(asset, scene_) {}

    Scene build() {
        for (const int node : tree_.visible) {
            const auto index = static_cast<std::size_t>(node);
            const tinygltf::Node& source = asset_.model.nodes[index];
            if (source.mesh != -1) {
                addMeshes(node);
            }
            if (source.camera != -1) {
                if (auto camera = readCamera(asset_, node, tree_.world_from_node[index])) {
                    scene_.cameras.push_back(std::move(*camera));
                }
            }
            if (auto light = readLight(asset_, node, tree_.world_from_node[index])) {
                scene_.lights.push_back(std::move(*light));
            }
        }
        if (!asset_.model.animations.empty()) {
            asset_.skip(fmt::format("{} animations are not played; the scene is in its rest pose",
                                    asset_.model.animations.size()));
        }
        materials_.finish();
        scene_.notes = asset_.notes;
        return std::move(scene_);
    }

private:
    void addMeshes(int node) {
        const auto index = static_cast<std::size_t>(node);
        const tinygltf::Node& source = asset_.model.nodes[index];
        const std::string name = objectName("node", index, source.name);
        const tinygltf::Mesh& mesh = at(asset_, asset_.model.meshes, source.mesh, name, "mesh");
        const std::vector<mat4> places = placesOf(node, name);
        if (places.empty()) {
            return;
        }
        for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
            const std::uint32_t made =
                source.skin != -1 || !source.weights.empty() ? makeMesh(node, p) : sharedMesh(node, p);
            if (made == kNone) {
                continue;
            }
            for (const mat4& world_from_object : places) {
                scene_.instances.push_back(
                    {source.name.empty() ? name : source.name, made, world_from_object});
            }
        }
    }

    /// Where the node places its mesh: once, or as often as its instances say. Those that cannot be are left
    /// out with a note.
    std::vector<mat4> placesOf(int node, const std::string& name) {
        const auto index = static_cast<std::size_t>(node);
        // A skinned mesh stands where its joints are; its node's own transform does not count
        // (glTF 2.0, 3.7.3.3).
        const bool skinned = asset_.model.nodes[index].skin != -1;
        const glm::dmat4 world_from_node = skinned ? glm::dmat4(1.0) : tree_.world_from_node[index];
        std::optional<std::vector<glm::dmat4>> instances = readInstances(asset_, node);
        if (instances && skinned) {
            asset_.warn(fmt::format("{}: it has a skin, so its instances count as one", name));
            instances.reset();
        }
        std::vector<mat4> places;
        std::size_t left_out = 0;
        std::string_view reason;
        for (const glm::dmat4& node_from_object : instances.value_or(std::vector{glm::dmat4(1.0)})) {
            const mat4 world_from_object(world_from_node * node_from_object);
            if (const std::string_view fault = placementFault(world_from_object); !fault.empty()) {
                ++left_out;
                reason = reason.empty() ? fault : reason;
            } else {
                places.push_back(world_from_object);
            }
        }
        if (left_out > 0) {
            asset_.skip(instances ? fmt::format("{}: {} of its {} instances: {}", name, left_out,
                                                instances->size(), reason)
                                  : fmt::format("{}: {}", name, reason));
        }
        return places;
    }

    /// A primitive that several nodes place is made once.
    std::uint32_t sharedMesh(int node, std::size_t primitive) {
        const std::pair key(asset_.model.nodes[static_cast<std::size_t>(node)].mesh, primitive);
        const auto known = shared_.find(key);
        return known != shared_.end() ? known->second
                                      : shared_.emplace(key, makeMesh(node, primitive)).first->second;
    }

    std::uint32_t makeMesh(int node, std::size_t primitive_index) {
        const tinygltf::Node& source = asset_.model.nodes[static_cast<std::size_t>(node)];
        const tinygltf::Mesh& mesh = asset_.model.meshes[static_cast<std::size_t>(source.mesh)];
        const tinygltf::Primitive& primitive = mesh.primitives[primitive_index];
        const std::string mesh_name = objectName("mesh", static_cast<std::size_t>(source.mesh), mesh.name);
        const std::string name = fmt::format("{} primitive {}", mesh_name, primitive_index);

        std::optional<Geometry> geometry =
            readGeometry(asset_, primitive, source.weights.empty() ? mesh.weights : source.weights, name);
        if (!geometry) {
            return kNone;
        }
        if (source.skin != -1 && !geometry->joints.empty()) {
            // Winding follows the node's transform, even where its skin alone places the mesh (3.7.4).
            const glm::dmat3 linear(tree_.world_from_node[static_cast<std::size_t>(node)]);
            applySkin(asset_, *geometry, jointTransforms(source.skin, name), glm::determinant(linear) < 0.0,
                      name);
        }
        removeUnplaceable(asset_, geometry->mesh, name);
        geometry->mesh.material = materials_.load(primitive.material, name);
        complete(asset_, geometry->mesh, scene_.materials[geometry->mesh.material], name);
        geometry->mesh.name = mesh.name.empty() ? mesh_name : mesh.name;
        if (mesh.primitives.size() > 1) {
            geometry->mesh.name += fmt::format(" #{}", primitive_index);
        }
        scene_.meshes.push_back(std::move(geometry->mesh));
        return static_cast<std::uint32_t>(scene_.meshes.size() - 1);
    }

    std::vector<glm::dmat4> jointTransforms(int skin_index, const std::string& object) {
        const tinygltf::Skin& skin = at(asset_, asset_.model.skins, skin_index, object, "skin");
        const std::string name = objectName("skin", static_cast<std::size_t>(skin_index), skin.name);
        if (skin.joints.empty()) {
            asset_.fail(name, "it has no joints");
        }
        std::vector<mat4> inverse_bind(skin.joints.size(), mat4(1.0F));
        if (skin.inverseBindMatrices != -1) {
            inverse_bind = readMat4(asset_, skin.inverseBindMatrices, name);
        }
        if (inverse_bind.size() < skin.joints.size()) {
            asset_.fail(name, fmt::format("it has {} joints and {} inverse bind matrices", skin.joints.size(),
                                          inverse_bind.size()));
        }
        std::vector<glm::dmat4> result;
        for (std::size_t j = 0; j < skin.joints.size(); ++j) {
            result.push_back(at(asset_, tree_.world_from_node, skin.joints[j], name, "joint node") *
                             glm::dmat4(inverse_bind[j]));
        }
        return result;
    }

    Asset& asset_;
    NodeTree tree_;
    Scene scene_;
    MaterialLoader materials_;
    std::map<std::pair<int, std::size_t>, std::uint32_t> shared_;
};

}  // namespace
}  // namespace gltf

namespace {

std::vector<std::filesystem::path> filesOf(const gltf::Asset& asset, const std::filesystem::path& path) {
    std::vector<std::filesystem::path> files{path};
    const auto add = [&](const std::string& uri) {
        if (auto file = asset.folder.find(uri)) files.push_back(std::move(*file));
    };
    for (const std::string& uri : asset.buffer_uris) add(uri);
    for (const gltf::ImageSource& image : asset.images) add(image.uri);
    return files;
}

}  // namespace

Scene loadGltf(const std::filesystem::path& path, const GltfOptions& options) {
    gltf::Asset asset = gltf::readAsset(path);
    asset.strict = options.strict;
    gltf::NodeTree tree = gltf::flattenNodes(asset, options.scene);
    gltf::requireBudget(asset, tree);
    const gltf::NodeTree as_stored = tree;
    glm::dvec3 origin = gltf::moveToOrigin(asset, tree);
    Scene scene = gltf::SceneBuilder(asset, std::move(tree)).build();
    // Bounds that accessors state may be wrong; what they moved no nearer stays where the file has it.
    if (origin != glm::dvec3(0.0) &&
        !(glm::length(glm::dvec3(sceneBounds(scene).centre())) < 0.5 * glm::length(origin))) {
        origin = glm::dvec3(0.0);
        scene = gltf::SceneBuilder(asset, as_stored).build();
    }
    scene.name = path.stem().string();
    scene.files = filesOf(asset, path);
    scene.origin = origin;
    warnOfCoarsePlaces(scene);
    return scene;
}

}  // namespace licht
