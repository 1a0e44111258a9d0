#pragma once
// Meshes made in code. Every mesh has unit normals and TEXCOORD_0, is counter-clockwise seen from the side
// its normals point to, and holds no degenerate triangle. Lengths are metres, angles radians; v grows
// downward in a picture, as in glTF.
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "licht/scene/scene.h"

namespace licht {

struct ShapeVertex {
    vec3 position;
    vec3 normal;
    vec2 uv;
};

/// A net of columns x rows quads over (columns + 1) x (rows + 1) vertices. The normal must be on the side of
/// d/dcolumn x d/drow. Triangles that have lost an edge (poles, creases) are left out.
Mesh gridMesh(std::string name, std::uint32_t material, std::uint32_t columns, std::uint32_t rows,
              const std::function<ShapeVertex(std::uint32_t column, std::uint32_t row)>& vertex);

/// A flat quad with corners counter-clockwise from the bottom left of its picture; uv covers [0,1]^2. Four
/// corners that are not in one plane give two flat triangles along the diagonal from the first to the third
/// corner.
Mesh quadMesh(std::string name, std::uint32_t material, const vec3& bottom_left, const vec3& bottom_right,
              const vec3& top_right, const vec3& top_left);

/// An axis-aligned solid box; uv in metres on each face.
Mesh boxMesh(std::string name, std::uint32_t material, const vec3& lower, const vec3& upper);

/// A solid box around the origin whose edges and corners are rounded with `radius` (at most half of the
/// smallest side); uv in metres.
Mesh roundedBoxMesh(std::string name, std::uint32_t material, const vec3& size, float radius,
                    std::uint32_t steps = 3);

/// A sphere around the origin; u along the equator, v from the north pole down.
Mesh sphereMesh(std::string name, std::uint32_t material, float radius, std::uint32_t segments,
                std::uint32_t rings);

/// A sphere around the origin of 20 * 4^halvings nearly equal triangles, from the icosahedron; every vertex
/// is on the sphere, to rounding. u and v as for sphereMesh; they tear where u ends.
Mesh icosphereMesh(std::string name, std::uint32_t material, float radius, std::uint32_t halvings);

/// A torus around the Y axis; radius of the circle of centres, then of the tube.
Mesh torusMesh(std::string name, std::uint32_t material, float ring_radius, float tube_radius,
               std::uint32_t segments, std::uint32_t sides);

/// A tube along a (p, q) torus knot around the Y axis: p turns around the axis, q around the ring.
struct TorusKnot {
    float p = 2.0F;
    float q = 3.0F;
    float ring_radius = 1.0F;
    float winding_radius = 0.4F;
    float tube_radius = 0.1F;
};
Mesh torusKnotMesh(std::string name, std::uint32_t material, const TorusKnot& knot, std::uint32_t segments,
                   std::uint32_t sides);

/// A surface of revolution around the Y axis. The profile is (radius, height), followed so that the outside
/// lies on its right: bottom to top for a solid. A point given twice is a crease. uv: u around, v along the
/// length of the profile in metres.
Mesh latheMesh(std::string name, std::uint32_t material, const std::vector<vec2>& profile,
               std::uint32_t segments);

/// A curve through all points (Catmull and Rom, "A class of local interpolating splines", 1974), `steps`
/// pieces between two of them.
std::vector<vec2> smoothProfile(const std::vector<vec2>& points, std::uint32_t steps);

/// A solid frustum from y = 0 to `height`; equal radii make a cylinder, an upper radius of zero a cone.
Mesh coneMesh(std::string name, std::uint32_t material, float lower_radius, float upper_radius, float height,
              std::uint32_t segments);

/// An upright sheet of width along +X and height along +Y from the origin, in `folds` waves of `depth` along
/// Z; it faces +Z.
Mesh curtainMesh(std::string name, std::uint32_t material, const vec2& size, std::uint32_t folds,
                 float depth);

/// Appends triangles and vertices of `part`, which must have the same material.
void appendMesh(Mesh& whole, const Mesh& part, const mat4& whole_from_part = mat4(1.0F));

}  // namespace licht
