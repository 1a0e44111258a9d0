#pragma once
// What tests ask of meshes: areas, volumes, whether they are closed.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <string_view>
#include <tuple>
#include <utility>

#include "licht/scene/scene.h"

namespace licht {

using glm::dvec3;

inline constexpr auto kEpsilon = static_cast<double>(std::numeric_limits<float>::epsilon());

inline dvec3 corner(const Mesh& mesh, const uvec3& triangle, int k) {
    return dvec3(mesh.positions[triangle[k]]);
}

inline dvec3 areaVector(const Mesh& mesh, const uvec3& triangle) {
    const dvec3 a = corner(mesh, triangle, 0);
    return 0.5 * glm::cross(corner(mesh, triangle, 1) - a, corner(mesh, triangle, 2) - a);
}

inline double area(const Mesh& mesh) {
    double sum = 0.0;
    for (const uvec3& triangle : mesh.triangles) sum += glm::length(areaVector(mesh, triangle));
    return sum;
}

/// Of a closed mesh: positive when its faces look outward (divergence theorem).
inline double signedVolume(const Mesh& mesh) {
    double sum = 0.0;
    for (const uvec3& triangle : mesh.triangles)
        sum += glm::dot(areaVector(mesh, triangle), corner(mesh, triangle, 0)) / 3.0;
    return sum;
}

/// Joins vertices in the same place, bit for bit, and says whether each edge has exactly one triangle on
/// either side.
inline bool isClosed(const Mesh& mesh) {
    using Point = std::tuple<float, float, float>;
    std::map<std::pair<Point, Point>, int> edges;
    for (const uvec3& triangle : mesh.triangles) {
        for (int k = 0; k < 3; ++k) {
            const vec3 a = mesh.positions[triangle[k]];
            const vec3 b = mesh.positions[triangle[(k + 1) % 3]];
            ++edges[{{a.x, a.y, a.z}, {b.x, b.y, b.z}}];
        }
    }
    return std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
        const auto opposite = edges.find({edge.first.second, edge.first.first});
        return edge.second == 1 && opposite != edges.end() && opposite->second == 1;
    });
}

inline const Mesh& meshNamed(const Scene& scene, std::string_view name) {
    const auto found =
        std::find_if(scene.meshes.begin(), scene.meshes.end(), [&](const Mesh& m) { return m.name == name; });
    EXPECT_NE(found, scene.meshes.end()) << name;
    return *found;
}

}  // namespace licht
