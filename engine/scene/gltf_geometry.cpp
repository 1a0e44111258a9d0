#include "licht/scene/gltf_geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "licht/scene/gltf_accessor.h"
#include "licht/scene/tangents.h"

namespace licht::gltf {
namespace {

/// v / |v|, or zero where v has no direction: such a vertex is shaded flat.
vec3 unitOrZero(const vec3& v) {
    const glm::dvec3 d(v);
    const double length = glm::length(d);
    return length > 0.0 && std::isfinite(length) ? vec3(d / length) : vec3(0.0F);
}

class AttributeReader {
public:
    AttributeReader(Asset& asset, const tinygltf::Primitive& primitive, const std::string& object)
        : asset_(asset), primitive_(primitive), object_(object) {}

    [[nodiscard]] bool has(const std::string& name) const { return primitive_.attributes.contains(name); }

    /// The attribute of that name, empty where there is none; its length must be `count`.
    template <typename Read>
    auto read(const std::string& name, std::size_t count, Read reader) const {
        return has(name) ? readChecked(primitive_.attributes.at(name), name, count, reader)
                         : decltype(reader(asset_, 0, std::string()))();
    }

    template <typename Read>
    auto readChecked(int accessor, const std::string& name, std::size_t count, Read reader) const {
        auto values = reader(asset_, accessor, fmt::format("{}: {}", object_, name));
        if (values.size() != count) {
            asset_.fail(object_,
                        fmt::format("{} has {} elements, POSITION has {}", name, values.size(), count));
        }
        return values;
    }

private:
    Asset& asset_;
    const tinygltf::Primitive& primitive_;
    const std::string& object_;
};

void addMorphTargets(const AttributeReader& attributes, const tinygltf::Primitive& primitive,
                     const std::vector<double>& weights, Mesh& mesh) {
    const std::size_t count = mesh.positions.size();
    const auto add = [&](const std::map<std::string, int>& target, const char* name, float weight,
                         auto& values) {
        const auto it = target.find(name);
        if (it == target.end() || values.empty()) {
            return;
        }
        const std::vector<vec3> deltas = attributes.readChecked(it->second, name, count, readVec3);
        for (std::size_t i = 0; i < count; ++i) {
            for (int c = 0; c < 3; ++c) {
                values[i][c] += weight * deltas[i][c];
            }
        }
    };
    for (std::size_t t = 0; t < std::min(primitive.targets.size(), weights.size()); ++t) {
        const auto weight = static_cast<float>(weights[t]);
        if (weight != 0.0F) {
            add(primitive.targets[t], "POSITION", weight, mesh.positions);
            add(primitive.targets[t], "NORMAL", weight, mesh.normals);
            add(primitive.targets[t], "TANGENT", weight, mesh.tangents);
        }
    }
}

void normalizeFrames(Mesh& mesh) {
    for (vec3& normal : mesh.normals) {
        normal = unitOrZero(normal);
    }
    for (vec4& tangent : mesh.tangents) {
        tangent = vec4(unitOrZero(vec3(tangent)), tangent.w < 0.0F ? -1.0F : 1.0F);
    }
}

/// Colours are factors of an albedo: [0,1].
void clampColors(Asset& asset, std::vector<vec4>& colors, const std::string& object) {
    bool outside = false;
    for (vec4& color : colors) {
        for (int c = 0; c < 4; ++c) {
            if (!(color[c] >= 0.0F && color[c] <= 1.0F)) {
                outside = true;
                color[c] = color[c] > 1.0F ? 1.0F : 0.0F;
            }
        }
    }
    if (outside) {
        asset.warn(fmt::format("{}: COLOR_0 leaves [0,1] and is clamped", object));
    }
}

void dropNonFiniteUvs(Asset& asset, std::vector<vec2>& uvs, const std::string& object) {
    std::size_t count = 0;
    for (vec2& uv : uvs) {
        if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) {
            uv = vec2(0.0F);
            ++count;
        }
    }
    if (count > 0) {
        asset.warn(fmt::format("{}: {} texture coordinates are not finite and taken as 0", object, count));
    }
}

void setUvs(Mesh& mesh, std::size_t set, std::vector<vec2> uvs) {
    while (mesh.uv_sets.size() <= set) {
        mesh.uv_sets.emplace_back();
    }
    mesh.uv_sets[set] = std::move(uvs);
}

/// Triangles of the list, strip or fan (glTF 2.0, 3.7.2.1). Those that name a vertex twice have no area and
/// are left out.
std::vector<uvec3> trianglesOf(const std::vector<std::uint32_t>& indices, int mode) {
    std::vector<uvec3> triangles;
    const auto add = [&triangles](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (a != b && b != c && c != a) {
            triangles.emplace_back(a, b, c);
        }
    };
    const std::size_t step = mode == TINYGLTF_MODE_TRIANGLES ? 3 : 1;
    triangles.reserve(indices.size() / step);
    for (std::size_t i = 0; i + 2 < indices.size(); i += step) {
        if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
            add(indices[i + 1], indices[i + 2], indices[0]);
        } else {
            const std::size_t flip = mode == TINYGLTF_MODE_TRIANGLE_STRIP ? i % 2 : 0;
            add(indices[i], indices[i + 1 + flip], indices[i + 2 - flip]);
        }
    }
    return triangles;
}

std::vector<std::uint32_t> readTriangleIndices(Asset& asset, const tinygltf::Primitive& primitive,
                                               std::size_t vertices, const std::string& object) {
    std::vector<std::uint32_t> indices(primitive.indices < 0 ? vertices : 0);
    if (primitive.indices < 0) {
        std::iota(indices.begin(), indices.end(), 0U);
    } else {
        indices = readIndices(asset, primitive.indices, fmt::format("{}: indices", object));
        const auto beyond = std::find_if(indices.begin(), indices.end(),
                                         [vertices](std::uint32_t i) { return i >= vertices; });
        if (beyond != indices.end()) {
            asset.fail(object, fmt::format("index {} at position {} names no vertex, there are {}", *beyond,
                                           beyond - indices.begin(), vertices));
        }
    }
    if (primitive.mode == TINYGLTF_MODE_TRIANGLES && indices.size() % 3 != 0) {
        asset.warn(fmt::format("{}: {} indices make no whole triangles; the last ones are left out", object,
                               indices.size()));
    }
    return indices;
}

void readAttributes(Asset& asset, const AttributeReader& attributes, const std::string& object,
                    Geometry& geometry) {
    Mesh& mesh = geometry.mesh;
    const std::size_t count = mesh.positions.size();
    mesh.normals = attributes.read("NORMAL", count, readVec3);
    // Without normals the faces are flat, and tangents MUST be ignored (glTF 2.0, 3.7.2.1).
    if (!mesh.normals.empty()) {
        mesh.tangents = attributes.read("TANGENT", count, readVec4);
    }
    mesh.colors = attributes.read("COLOR_0", count, readColors);
    clampColors(asset, mesh.colors, object);
    for (int set = 0; set < kMaxUvSets; ++set) {
        const std::string name = fmt::format("TEXCOORD_{}", set);
        if (attributes.has(name)) {
            std::vector<vec2> uvs = attributes.read(name, count, readVec2);
            dropNonFiniteUvs(asset, uvs, object);
            setUvs(mesh, static_cast<std::size_t>(set), std::move(uvs));
        }
    }
    for (int set = 0;
         attributes.has(fmt::format("JOINTS_{}", set)) && attributes.has(fmt::format("WEIGHTS_{}", set));
         ++set) {
        geometry.joints.push_back(attributes.read(fmt::format("JOINTS_{}", set), count, readJoints));
        geometry.weights.push_back(attributes.read(fmt::format("WEIGHTS_{}", set), count, readVec4));
    }
}

}  // namespace

std::optional<Geometry> readGeometry(Asset& asset, const tinygltf::Primitive& primitive,
                                     const std::vector<double>& morph_weights, const std::string& object) {
    if (primitive.mode >= TINYGLTF_MODE_POINTS && primitive.mode <= TINYGLTF_MODE_LINE_STRIP) {
        asset.skip(fmt::format("{}: {} are not drawn", object,
                               primitive.mode == TINYGLTF_MODE_POINTS ? "points" : "lines"));
        return std::nullopt;
    }
    if (primitive.mode < TINYGLTF_MODE_POINTS || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
        asset.fail(object, fmt::format("mode {} is unknown", primitive.mode));
    }
    const AttributeReader attributes(asset, primitive, object);
    if (!attributes.has("POSITION")) {
        asset.skip(fmt::format("{}: it has no POSITION", object));
        return std::nullopt;
    }
    Geometry geometry;
    Mesh& mesh = geometry.mesh;
    mesh.positions =
        readVec3(asset, primitive.attributes.at("POSITION"), fmt::format("{}: POSITION", object));
    readAttributes(asset, attributes, object, geometry);
    addMorphTargets(attributes, primitive, morph_weights, mesh);
    normalizeFrames(mesh);
    mesh.triangles =
        trianglesOf(readTriangleIndices(asset, primitive, mesh.positions.size(), object), primitive.mode);
    if (mesh.triangles.empty()) {
        asset.skip(fmt::format("{}: it has no triangles", object));
        return std::nullopt;
    }
    return geometry;
}

void applySkin(const Asset& asset, Geometry& geometry, const std::vector<glm::dmat4>& world_from_bind,
               bool mirrored, const std::string& object) {
    Mesh& mesh = geometry.mesh;
    if (mirrored) {
        for (uvec3& triangle : mesh.triangles) {
            std::swap(triangle.y, triangle.z);
        }
    }
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        glm::dmat4 blend(0.0);
        double sum = 0.0;
        for (std::size_t set = 0; set < geometry.joints.size(); ++set) {
            for (int k = 0; k < 4; ++k) {
                const double weight = static_cast<double>(geometry.weights[set][i][k]);
                const std::uint32_t joint = geometry.joints[set][i][k];
                if (weight == 0.0) {
                    continue;
                }
                if (joint >= world_from_bind.size()) {
                    asset.fail(object, fmt::format("vertex {} names joint {}, the skin has {}", i, joint,
                                                   world_from_bind.size()));
                }
                blend += weight * world_from_bind[joint];
                sum += weight;
            }
        }
        // The specification asks for a sum of one; a vertex that no joint holds follows the first.
        blend = sum != 0.0 ? blend / sum : world_from_bind.front();
        mesh.positions[i] = vec3(blend * glm::dvec4(glm::dvec3(mesh.positions[i]), 1.0));
        const glm::dmat3 linear(blend);
        if (!mesh.normals.empty()) {
            // The cofactor matrix: det * inverse transpose, which exists for every matrix.
            const glm::dmat3 cofactor(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                                      glm::cross(linear[0], linear[1]));
            const double side = glm::determinant(linear) < 0.0 ? -1.0 : 1.0;
            mesh.normals[i] = unitOrZero(vec3(side * (cofactor * glm::dvec3(mesh.normals[i]))));
        }
        if (!mesh.tangents.empty()) {
            mesh.tangents[i] =
                vec4(unitOrZero(vec3(linear * glm::dvec3(vec3(mesh.tangents[i])))), mesh.tangents[i].w);
        }
    }
}

void removeUnplaceable(Asset& asset, Mesh& mesh, const std::string& object) {
    const std::size_t removed = std::erase_if(mesh.triangles, [&mesh](const uvec3& t) {
        return !isPlace(mesh.positions[t.x]) || !isPlace(mesh.positions[t.y]) ||
               !isPlace(mesh.positions[t.z]);
    });
    if (removed > 0) {
        asset.warn(
            fmt::format("{}: {} triangles with a vertex that is not finite or too far out are left out",
                        object, removed));
    }
}

void complete(Asset& asset, Mesh& mesh, const Material& material, const std::string& object) {
    for (const TextureSlot& slot : material.slots) {
        if (slot.present() && (mesh.uv_sets.size() <= slot.uv_set || mesh.uv_sets[slot.uv_set].empty())) {
            setUvs(mesh, slot.uv_set, std::vector<vec2>(mesh.positions.size(), vec2(0.0F)));
            asset.warn(fmt::format("{}: material '{}' reads TEXCOORD_{}, which is not there and taken as 0",
                                   object, material.name, slot.uv_set));
        }
    }
    if (const TextureSlot* map = material.normalMap(); map != nullptr && mesh.tangents.empty()) {
        deriveTangents(mesh, *map);
    }
}

}  // namespace licht::gltf
