#pragma once
#include <vector>

#include "licht/bvh/instances.h"
#include "licht/scene/effects.h"
#include "licht/scene/scene.h"
#include "licht/shared/geometry.h"

namespace licht {

/// The order of instances on the device: baked ones as the scene has them, then the instanced ones, those of
/// one mesh (and of one handedness) side by side, so that each group is drawn at once.
struct InstanceOrder {
    std::vector<uint> scene_instance;   ///< per instance on the device
    std::vector<uint> device_instance;  ///< per instance of the scene
    uint baked = 0;                     ///< how many come first
};
InstanceOrder orderInstances(const Scene& scene, const Effects& effects);

/// An instanced mesh.
struct MeshPiece {
    uint first_triangle = 0;
    uint triangle_count = 0;
    std::vector<BvhTriangle> triangles;  ///< for the BVH builder
};

/// A scene as lists of vertices and triangles: baked instances in world space, then each instanced mesh once,
/// in object space and seen from its centre. Rasteriser and BVH read the same positions, so both see the same
/// surfaces.
struct FlatGeometry {
    std::vector<VertexRecord> vertices;
    std::vector<uint> indices;  ///< three per triangle; baked mirrored instances are turned so that fronts
                                ///< stay counter-clockwise
    std::vector<InstanceRecord> instances;  ///< in the order of InstanceOrder
    std::vector<uint> triangle_instances;   ///< per baked triangle
    std::vector<MeshPiece> pieces;          ///< the instanced meshes
    std::vector<BvhInstance> placements;    ///< per instanced one; .mesh counts pieces
    std::vector<vec4> tangents;   ///< empty unless normal maps are called for; zero where a mesh has none
    std::vector<vec4> colors;     ///< empty unless vertex colours are called for; white where a mesh has none
    std::vector<vec2> extra_uvs;  ///< extra_uv_sets per vertex
    uint extra_uv_sets = 0;
    Bounds bounds;  ///< of the baked vertices
};

/// `first_light`: per instance of the scene.
FlatGeometry flattenGeometry(const Scene& scene, const Effects& effects, const InstanceOrder& order,
                             const std::vector<uint>& first_light);

/// The baked triangles for the BVH builder.
std::vector<BvhTriangle> worldTriangles(const FlatGeometry& geometry);

}  // namespace licht
