#include "licht/scene/tangents.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace licht {
namespace {

using glm::dvec2;
using glm::dvec3;

/// v / |v|, or zero where v has no direction.
dvec3 unitOrZero(const dvec3& v) {
    const double length = glm::length(v);
    return length > 0.0 && std::isfinite(length) ? v / length : dvec3(0.0);
}

/// A unit vector orthogonal to a unit normal (Duff et al. 2017, Building an Orthonormal Basis, Revisited).
dvec3 anyTangent(const dvec3& n) {
    const double sign = std::copysign(1.0, n.z);
    const double a = -1.0 / (sign + n.z);
    return {1.0 + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x};
}

/// A triangle's directions of growing u and v.
struct Gradients {
    dvec3 u{0.0};
    dvec3 v{0.0};
};

Gradients gradients(const std::array<dvec3, 3>& p, const std::array<dvec2, 3>& uv) {
    const dvec3 e1 = p[1] - p[0];
    const dvec3 e2 = p[2] - p[0];
    const dvec2 d1 = uv[1] - uv[0];
    const dvec2 d2 = uv[2] - uv[0];
    // Only the sign of the determinant matters: both gradients are made unit.
    const double side = std::copysign(1.0, d1.x * d2.y - d2.x * d1.y);
    if (d1.x * d2.y == d2.x * d1.y) {
        return {};
    }
    return {unitOrZero(side * (d2.y * e1 - d1.y * e2)), unitOrZero(side * (d1.x * e2 - d2.x * e1))};
}

double cornerAngle(const std::array<dvec3, 3>& p, std::size_t corner) {
    const dvec3 a = unitOrZero(p.at((corner + 1) % 3) - p.at(corner));
    const dvec3 b = unitOrZero(p.at((corner + 2) % 3) - p.at(corner));
    return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
}

}  // namespace

void deriveTangents(Mesh& mesh, const TextureSlot& slot) {
    const std::size_t n = mesh.positions.size();
    const bool has_uvs = slot.uv_set < mesh.uv_sets.size() && !mesh.uv_sets[slot.uv_set].empty();
    std::vector<Gradients> sums(n);
    std::vector<dvec3> normals(n, dvec3(0.0));

    for (const uvec3& triangle : mesh.triangles) {
        std::array<dvec3, 3> p{};
        std::array<dvec2, 3> uv{};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = triangle[static_cast<int>(k)];
            p.at(k) = dvec3(mesh.positions[vertex]);
            if (has_uvs) {
                const vec3 raw(mesh.uv_sets[slot.uv_set][vertex], 1.0F);
                uv.at(k) = dvec2(glm::dot(dvec3(slot.u_from_uv), dvec3(raw)),
                                 glm::dot(dvec3(slot.v_from_uv), dvec3(raw)));
            }
        }
        const Gradients g = gradients(p, uv);
        const dvec3 face = unitOrZero(glm::cross(p[1] - p[0], p[2] - p[0]));
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = triangle[static_cast<int>(k)];
            const double angle = cornerAngle(p, k);
            sums[vertex].u += angle * g.u;
            sums[vertex].v += angle * g.v;
            normals[vertex] += angle * face;
        }
    }

    mesh.tangents.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        dvec3 normal = unitOrZero(mesh.normals.empty() ? normals[i] : dvec3(mesh.normals[i]));
        normal = normal == dvec3(0.0) ? dvec3(0, 0, 1) : normal;
        dvec3 tangent = unitOrZero(sums[i].u - normal * glm::dot(normal, sums[i].u));
        tangent = tangent == dvec3(0.0) ? anyTangent(normal) : tangent;
        const bool upward = glm::dot(glm::cross(normal, tangent), sums[i].v) <= 0.0;
        mesh.tangents[i] = vec4(vec3(tangent), upward ? 1.0F : -1.0F);
    }
}

}  // namespace licht
