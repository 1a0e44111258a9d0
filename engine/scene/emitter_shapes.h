#pragma once
// Shapes among the triangles of what shines: a whole one is sampled better than its triangles are.
#include <array>
#include <cstddef>
#include <optional>

#include "licht/scene/scene.h"

namespace licht {

/// World space, in the order in which rays meet them.
using Corners = std::array<vec3, 3>;
Corners worldCorners(const Mesh& mesh, const mat4& world_from_object, std::size_t triangle);

/// A corner and two edges that turn counter-clockwise, seen from the front.
struct Rectangle {
    vec3 corner, first_edge, second_edge;
};

/// Two triangles that are the halves of a rectangle.
std::optional<Rectangle> rectangleOf(const Corners& a, const Corners& b);

/// What a closed mesh fills nearly: a ball around its centre of mass.
struct Ball {
    vec3 centre;   ///< world
    float radius;  ///< of the smallest one with that centre that holds the mesh
    double inner;  ///< radius of the largest one that no face's plane cuts
    double area;   ///< of the mesh, m^2
};

/// None where the mesh is not closed, or a face of it turns its back on what is outside. Positions closer
/// than 2^-20 of the radius count as one, so seams and poles may be made of vertices of their own.
std::optional<Ball> ballOf(const Mesh& mesh, const mat4& world_from_object);

/// What is sampled as one light: a mesh of one emission, without holes, that is round enough.
std::optional<Ball> roundEmitter(const Scene& scene, const Instance& instance);

}  // namespace licht
