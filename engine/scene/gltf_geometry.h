#pragma once
// Primitives as meshes of triangles, in the rest pose.
#include <vector>

#include "licht/scene/gltf_asset.h"
#include "licht/scene/gltf_material.h"
#include "licht/scene/scene.h"

namespace licht::gltf {

/// A primitive's mesh without its material, and what a skin needs.
struct Geometry {
    Mesh mesh;
    std::vector<std::vector<uvec4>> joints;  ///< JOINTS_n
    std::vector<std::vector<vec4>> weights;  ///< WEIGHTS_n
};

/// Reads attributes, applies morph targets by `morph_weights`, and makes triangles of any mode. nullopt, with
/// a note, where nothing can be drawn. Throws InputError naming mesh and primitive when the data is damaged.
std::optional<Geometry> readGeometry(Asset& asset, const tinygltf::Primitive& primitive,
                                     const std::vector<double>& morph_weights, const std::string& object);

/// Moves the vertices to where the joints hold them: linear blend skinning. `world_from_bind` is one matrix
/// per joint; mirrored: by the node's own transform, which turns the winding. Throws InputError when a vertex
/// names a joint that is not there.
void applySkin(const Asset& asset, Geometry& geometry, const std::vector<glm::dmat4>& world_from_bind,
               bool mirrored, const std::string& object);

/// Removes triangles with a vertex that is no place (not finite, or too far out), with one warning that
/// counts them.
void removeUnplaceable(Asset& asset, Mesh& mesh, const std::string& object);

/// Gives the mesh what its material reads and it does not have: texture coordinates (zero, with a warning)
/// and tangents (derived).
void complete(Asset& asset, Mesh& mesh, const Material& material, const std::string& object);

}  // namespace licht::gltf
