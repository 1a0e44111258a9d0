#pragma once
#include <vector>

#include "licht/bvh/bvh.h"
#include "licht/scene/effects.h"
#include "licht/scene/scene.h"
#include "licht/shared/records.h"

namespace licht {

/// All instances of a scene as one list of triangles in world space. Rasteriser and BVH read the same
/// positions, so both see the same surfaces.
struct FlatGeometry {
    std::vector<VertexRecord> vertices;
    std::vector<uint>
        indices;  ///< three per triangle; mirrored instances are turned so that fronts stay counter-clockwise
    std::vector<InstanceRecord> instances;  ///< one per scene instance, in order
    std::vector<uint> triangle_instances;   ///< per triangle
    std::vector<vec4> tangents;   ///< empty unless normal maps are called for; zero where a mesh has none
    std::vector<vec4> colors;     ///< empty unless vertex colours are called for; white where a mesh has none
    std::vector<vec2> extra_uvs;  ///< extra_uv_sets per vertex
    uint extra_uv_sets = 0;
    Bounds bounds;
};

FlatGeometry flattenGeometry(const Scene& scene, const Effects& effects,
                             const std::vector<uint>& first_light);

/// The triangles for the BVH builder.
std::vector<BvhTriangle> worldTriangles(const FlatGeometry& geometry);

}  // namespace licht
