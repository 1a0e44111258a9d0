#include "licht/scene/tangents.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace licht {
namespace {

using glm::dvec2;
using glm::dvec3;

/// v / |v|, or zero where v has no direction.
dvec3 unitOrZero(const dvec3& v) {
    const double length = glm::length(v);
    return length > 0.0 && std::isfinite(length) ? v / length : dvec3(0.0);
}

dvec3 acrossNormal(const dvec3& v, const dvec3& n) {
    return unitOrZero(v - n * glm::dot(n, v));
}

/// A unit vector orthogonal to a unit normal (Duff et al. 2017, Building an Orthonormal Basis, Revisited).
dvec3 anyTangent(const dvec3& n) {
    const double sign = std::copysign(1.0, n.z);
    const double a = -1.0 / (sign + n.z);
    return {1.0 + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x};
}

/// A triangle as its texture lies on it.
struct Face {
    std::array<dvec3, 3> p{};
    dvec3 normal{0.0};  ///< zero: it has no area
    dvec3 u{0.0};       ///< unit, the direction of growing u; zero: the texture shrinks to a line there
    int side = 0;       ///< 1: u and v as seen from its front turn as x and y do; -1: mirrored; 0: neither
};

Face faceOf(const Mesh& mesh, const TextureSlot& slot, const uvec3& triangle) {
    Face face;
    std::array<dvec2, 3> uv{};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t vertex = triangle[static_cast<int>(k)];
        face.p.at(k) = dvec3(mesh.positions[vertex]);
        const dvec3 raw(mesh.uv(slot.uv_set, vertex), 1.0);
        uv.at(k) = dvec2(glm::dot(dvec3(slot.u_from_uv), raw), glm::dot(dvec3(slot.v_from_uv), raw));
    }
    const dvec3 e1 = face.p[1] - face.p[0];
    const dvec3 e2 = face.p[2] - face.p[0];
    const dvec2 d1 = uv[1] - uv[0];
    const dvec2 d2 = uv[2] - uv[0];
    face.normal = unitOrZero(glm::cross(e1, e2));
    const double left = d1.x * d2.y;
    const double right = d2.x * d1.y;
    if (left != right) {
        face.side = left > right ? 1 : -1;
        face.u = unitOrZero(static_cast<double>(face.side) * (d2.y * e1 - d1.y * e2));
    }
    return face;
}

/// Angle at a corner, seen along the normal there.
double cornerAngle(const Face& face, std::size_t corner, const dvec3& normal) {
    const dvec3 a = acrossNormal(face.p.at((corner + 1) % 3) - face.p.at(corner), normal);
    const dvec3 b = acrossNormal(face.p.at((corner + 2) % 3) - face.p.at(corner), normal);
    return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
}

/// What corners have in common that share a tangent: position, normal, texture coordinates and side.
struct Key {
    std::array<float, 9> numbers{};
    bool operator==(const Key&) const = default;
};

struct KeyHash {
    std::size_t operator()(const Key& key) const {
        return std::hash<std::string_view>()(
            {reinterpret_cast<const char*>(key.numbers.data()), sizeof(key.numbers)});
    }
};

/// The corners of one key, which share one tangent.
struct Group {
    dvec3 normal{0.0};
    dvec3 sum{0.0};
    int side = 1;
};

/// Appends a copy of a vertex; returns its number.
std::uint32_t copyVertex(Mesh& mesh, std::uint32_t vertex) {
    const auto copy = [vertex](auto& values) {
        if (!values.empty()) {
            const auto value = values[vertex];
            values.push_back(value);
        }
    };
    copy(mesh.positions);
    copy(mesh.normals);
    copy(mesh.colors);
    for (std::vector<vec2>& uvs : mesh.uv_sets) {
        copy(uvs);
    }
    return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

class TangentBuilder {
public:
    TangentBuilder(Mesh& mesh, const TextureSlot& slot) : mesh_(mesh), slot_(slot) {}

    void build() {
        faces_.reserve(mesh_.triangles.size());
        for (const uvec3& triangle : mesh_.triangles) {
            faces_.push_back(faceOf(mesh_, slot_, triangle));
        }
        corner_groups_.resize(3 * faces_.size());
        // Where the texture shrinks to a line a face takes the tangents of its neighbours.
        for (const bool with_side : {true, false}) {
            for (std::size_t t = 0; t < faces_.size(); ++t) {
                if ((faces_[t].side != 0) == with_side) {
                    addFace(t);
                }
            }
        }
        giveToVertices();
    }

private:
    [[nodiscard]] dvec3 normalAt(const Face& face, std::uint32_t vertex) const {
        const dvec3 n = mesh_.normals.empty() ? dvec3(0.0) : dvec3(mesh_.normals[vertex]);
        const dvec3 normal = n == dvec3(0.0) ? face.normal : unitOrZero(n);
        return normal == dvec3(0.0) ? dvec3(0, 0, 1) : normal;
    }

    [[nodiscard]] Key keyOf(std::uint32_t vertex, const dvec3& normal, int side) const {
        const vec3 p = mesh_.positions[vertex];
        const vec3 n(normal);
        const vec2 uv = mesh_.uv(slot_.uv_set, vertex);
        Key key{{p.x, p.y, p.z, n.x, n.y, n.z, uv.x, uv.y, static_cast<float>(side)}};
        for (float& number : key.numbers) {
            number += 0.0F;  // one zero, not two
        }
        return key;
    }

    std::size_t groupOf(const Key& key, const dvec3& normal, int side) {
        const auto [it, is_new] = known_.try_emplace(key, groups_.size());
        if (is_new) {
            groups_.push_back({normal, dvec3(0.0), side});
        }
        return it->second;
    }

    void addFace(std::size_t t) {
        const Face& face = faces_[t];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = mesh_.triangles[t][static_cast<int>(k)];
            const dvec3 normal = normalAt(face, vertex);
            int side = face.side;
            if (side == 0) {
                side =
                    known_.contains(keyOf(vertex, normal, 1)) || !known_.contains(keyOf(vertex, normal, -1))
                        ? 1
                        : -1;
            }
            const std::size_t group = groupOf(keyOf(vertex, normal, side), normal, side);
            groups_[group].sum += cornerAngle(face, k, normal) * acrossNormal(face.u, normal);
            corner_groups_[3 * t + k] = group;
        }
    }

    /// A vertex whose corners belong to several groups is split.
    void giveToVertices() {
        constexpr std::size_t kNoGroup = ~std::size_t{0};
        std::vector<std::size_t> vertex_groups(mesh_.positions.size(), kNoGroup);
        std::unordered_map<std::size_t, std::vector<std::uint32_t>> copies;  // of a vertex, beside itself
        for (std::size_t t = 0; t < faces_.size(); ++t) {
            for (std::size_t k = 0; k < 3; ++k) {
                std::uint32_t& vertex = mesh_.triangles[t][static_cast<int>(k)];
                const std::size_t group = corner_groups_[3 * t + k];
                if (vertex_groups[vertex] == kNoGroup) {
                    vertex_groups[vertex] = group;
                }
                if (vertex_groups[vertex] == group) {
                    continue;
                }
                std::vector<std::uint32_t>& of_vertex = copies[vertex];
                const auto it = std::find_if(of_vertex.begin(), of_vertex.end(),
                                             [&](std::uint32_t c) { return vertex_groups[c] == group; });
                if (it == of_vertex.end()) {
                    of_vertex.push_back(copyVertex(mesh_, vertex));
                    vertex_groups.push_back(group);
                    vertex = of_vertex.back();
                } else {
                    vertex = *it;
                }
            }
        }
        mesh_.tangents.clear();
        for (const std::size_t group : vertex_groups) {
            mesh_.tangents.push_back(group == kNoGroup ? vec4(1, 0, 0, 1) : tangentOf(groups_[group]));
        }
    }

    static vec4 tangentOf(const Group& group) {
        const dvec3 tangent = acrossNormal(group.sum, group.normal);
        // v grows downwards in glTF's pictures, and the bitangent goes up in them.
        return {vec3(tangent == dvec3(0.0) ? anyTangent(group.normal) : tangent),
                group.side > 0 ? -1.0F : 1.0F};
    }

    Mesh& mesh_;
    const TextureSlot& slot_;
    std::vector<Face> faces_;
    std::vector<Group> groups_;
    std::vector<std::size_t> corner_groups_;
    std::unordered_map<Key, std::size_t, KeyHash> known_;
};

}  // namespace

void deriveTangents(Mesh& mesh, const TextureSlot& slot) {
    TangentBuilder(mesh, slot).build();
}

}  // namespace licht
