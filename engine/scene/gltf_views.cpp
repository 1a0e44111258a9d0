#include "licht/scene/gltf_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace licht::gltf {
namespace {

using glm::dmat4;
using glm::dvec3;

bool isPlace(const dvec3& v) {
    return licht::isPlace(vec3(v));
}

/// Rotation and translation of a transform: back axis first, then up; scale and shear are dropped. nullopt
/// where an axis has no length.
std::optional<mat4> rigid(const dmat4& m) {
    const dvec3 right = glm::cross(dvec3(m[1]), dvec3(m[2]));
    if (!isPlace(dvec3(m[3])) || !(glm::length(right) > 0.0) || !std::isfinite(glm::length(right))) {
        return std::nullopt;
    }
    const dvec3 back = glm::normalize(dvec3(m[2]));
    const dvec3 x = glm::normalize(right);
    mat4 result(1.0F);
    result[0] = vec4(vec3(x), 0.0F);
    result[1] = vec4(vec3(glm::cross(back, x)), 0.0F);
    result[2] = vec4(vec3(back), 0.0F);
    result[3] = vec4(vec3(dvec3(m[3])), 1.0F);
    return result;
}

float finiteOr(double value, float fallback) {
    const auto narrow = static_cast<float>(value);
    return std::isfinite(narrow) ? narrow : fallback;
}

/// color * intensity, each clamped to what light can be.
vec3 intensityOf(Asset& asset, const tinygltf::Light& light, const std::string& name) {
    vec3 result(1.0F);
    bool changed = false;
    for (int c = 0; c < 3; ++c) {
        const double factor = light.color.size() == 3 ? light.color[static_cast<std::size_t>(c)] : 1.0;
        const double wanted = factor * light.intensity;
        const double possible = std::clamp(std::isnan(wanted) ? 0.0 : wanted, 0.0,
                                           static_cast<double>(std::numeric_limits<float>::max()));
        changed = changed || possible != wanted;
        result[c] = static_cast<float>(possible);
    }
    if (changed) {
        asset.warn(fmt::format("{}: its intensity is outside of its range and clamped", name));
    }
    return result;
}

}  // namespace

std::optional<Camera> readCamera(Asset& asset, int node, const dmat4& world_from_node) {
    const tinygltf::Node& carrier = asset.model.nodes[static_cast<std::size_t>(node)];
    const std::string node_name = objectName("node", static_cast<std::size_t>(node), carrier.name);
    const tinygltf::Camera& source = at(asset, asset.model.cameras, carrier.camera, node_name, "camera");
    const std::string name = objectName("camera", static_cast<std::size_t>(carrier.camera), source.name);
    const std::optional<mat4> frame = rigid(world_from_node);
    if (!frame) {
        asset.skip(fmt::format("{}: {} gives it no direction", name, node_name));
        return std::nullopt;
    }
    Camera camera;
    camera.name = !source.name.empty() ? source.name : !carrier.name.empty() ? carrier.name : name;
    camera.node = carrier.name;
    camera.world_from_view = *frame;
    if (source.type == "orthographic") {
        const double half_height = std::abs(source.orthographic.ymag);
        camera.kind = Camera::Kind::orthographic;
        camera.y_extent = finiteOr(half_height, 0.0F);
        camera.aspect =
            half_height > 0.0 ? finiteOr(std::abs(source.orthographic.xmag) / half_height, 0.0F) : 0.0F;
        camera.z_near = std::max(0.0F, finiteOr(source.orthographic.znear, 0.0F));
        if (!(camera.y_extent > 0.0F)) {
            asset.skip(fmt::format("{}: its ymag is zero or not finite", name));
            return std::nullopt;
        }
    } else {
        camera.y_fov = finiteOr(source.perspective.yfov, 0.0F);
        camera.aspect = std::max(0.0F, finiteOr(source.perspective.aspectRatio, 0.0F));
        camera.z_near = std::max(0.0F, finiteOr(source.perspective.znear, 0.0F));
        if (!(camera.y_fov > 0.0F && camera.y_fov < kPi)) {
            asset.skip(fmt::format("{}: its vertical angle {} lies outside of (0, pi)", name,
                                   source.perspective.yfov));
            return std::nullopt;
        }
    }
    const double z_far = source.type == "orthographic" ? source.orthographic.zfar : source.perspective.zfar;
    if (z_far > 0.0) {
        camera.z_far = std::max(0.0F, finiteOr(z_far, 0.0F));
        if (camera.z_far <= camera.z_near) {
            asset.warn(fmt::format("{}: its zfar is not behind its znear and taken as none", name));
            camera.z_far = 0.0F;
        }
    }
    return camera;
}

std::optional<PunctualLight> readLight(Asset& asset, int node, const dmat4& world_from_node) {
    const tinygltf::Node& carrier = asset.model.nodes[static_cast<std::size_t>(node)];
    const auto extension = carrier.extensions.find("KHR_lights_punctual");
    if (extension == carrier.extensions.end() || !extension->second.Has("light")) {
        return std::nullopt;
    }
    const std::string node_name = objectName("node", static_cast<std::size_t>(node), carrier.name);
    if (!extension->second.Get("light").IsInt()) asset.fail(node_name, "its light is no index");
    const int index = extension->second.Get("light").GetNumberAsInt();
    const tinygltf::Light& source = at(asset, asset.model.lights, index, node_name, "light");
    const std::string name = objectName("light", static_cast<std::size_t>(index), source.name);

    PunctualLight light;
    light.name = !source.name.empty() ? source.name : !carrier.name.empty() ? carrier.name : name;
    if (source.type == "point") {
        light.kind = PunctualLight::Kind::point;
    } else if (source.type == "spot") {
        light.kind = PunctualLight::Kind::spot;
    } else if (source.type == "directional") {
        light.kind = PunctualLight::Kind::directional;
    } else {
        asset.skip(fmt::format("{}: its type '{}' is unknown", name, oneLine(source.type)));
        return std::nullopt;
    }
    const dvec3 backwards(world_from_node[2]);
    const bool directed = glm::length(backwards) > 0.0 && std::isfinite(glm::length(backwards));
    if (!isPlace(dvec3(world_from_node[3])) || (!directed && light.kind != PunctualLight::Kind::point)) {
        asset.skip(fmt::format("{}: {} gives it no place or no direction", name, node_name));
        return std::nullopt;
    }
    light.position = vec3(dvec3(world_from_node[3]));
    light.direction = directed ? -vec3(glm::normalize(backwards)) : light.direction;
    light.intensity = intensityOf(asset, source, name);
    light.range = std::max(0.0F, finiteOr(source.range, 0.0F));
    if (light.kind == PunctualLight::Kind::spot) {
        const double outer = std::clamp(source.spot.outerConeAngle, 0.0, 0.5 * std::numbers::pi);
        const double inner = std::clamp(source.spot.innerConeAngle, 0.0, outer);
        if (outer != source.spot.outerConeAngle || inner != source.spot.innerConeAngle) {
            asset.warn(fmt::format("{}: its cone angles are outside of their range and clamped", name));
        }
        light.outer_cone = std::min(static_cast<float>(outer), 0.5F * kPi);
        light.inner_cone = std::min(static_cast<float>(inner), light.outer_cone);
    }
    return light;
}

}  // namespace licht::gltf
