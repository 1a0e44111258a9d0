#include "licht/scene/scene.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace licht {

bool isPlace(const vec3& point) {
    // The comparison is false for NaN.
    return std::abs(point.x) <= kMaxCoordinate && std::abs(point.y) <= kMaxCoordinate &&
           std::abs(point.z) <= kMaxCoordinate;
}

Bounds sceneBounds(const Scene& scene) {
    Bounds bounds;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        for (const uvec3& triangle : mesh.triangles) {
            std::array<vec3, 3> corners{};
            for (int k = 0; k < 3; ++k) {
                corners.at(static_cast<std::size_t>(k)) =
                    vec3(instance.world_from_object * vec4(mesh.positions[triangle[k]], 1.0F));
            }
            if (std::all_of(corners.begin(), corners.end(), isPlace)) {
                for (const vec3& corner : corners) {
                    bounds.extend(corner);
                }
            }
        }
    }
    return bounds;
}

namespace {

constexpr float kFramingFov = 0.8F;     // radians: the default of Camera
constexpr float kFramingFill = 0.9F;    // share of the half picture that the box may reach: 10 % margin
constexpr float kNearShare = 1e-3F;     // of the distance to the centre
constexpr float kEmptyDistance = 3.0F;  // metres, where nothing tells a size
constexpr float kResolvedShare =
    1e-5F;  // of the coordinates: nearer, an eye and what it sees round to the same point
const vec3 kTowardsEye{0.45F, 0.35F, 1};  // front, a bit to the right and above

/// Distance from the centre at which all corners of the box are inside the picture's fill, and the nearest
/// corner's depth there.
struct Framing {
    float distance = 0.0F;
    float nearest = 0.0F;
};

Framing frameBox(const Bounds& bounds, const mat3& view_axes, float tan_x, float tan_y) {
    const vec3 half = 0.5F * bounds.upper - 0.5F * bounds.lower;
    Framing framing;
    float highest = 0.0F;
    for (int corner = 0; corner < 8; ++corner) {
        const vec3 sign((corner & 1) != 0 ? 1.0F : -1.0F, (corner & 2) != 0 ? 1.0F : -1.0F,
                        (corner & 4) != 0 ? 1.0F : -1.0F);
        const vec3 p = glm::transpose(view_axes) * (sign * half);
        const float depth =
            std::max(std::abs(p.x) / (kFramingFill * tan_x), std::abs(p.y) / (kFramingFill * tan_y));
        framing.distance = std::max(framing.distance, p.z + depth);
        highest = std::max(highest, p.z);
    }
    framing.nearest = framing.distance - highest;
    return framing;
}

}  // namespace

Camera framingCamera(const Bounds& bounds, float aspect) {
    const float width_per_height = aspect > 0.0F && std::isfinite(aspect) ? aspect : 1.0F;
    const vec3 back = glm::normalize(kTowardsEye);
    const vec3 right = glm::normalize(glm::cross(vec3(0, 1, 0), back));
    const mat3 axes(right, glm::cross(back, right), back);
    const vec3 centre = bounds.empty() ? vec3(0.0F) : bounds.centre();

    Framing framing{kEmptyDistance, kEmptyDistance};
    if (!bounds.empty() && bounds.radius() > 0.0F) {
        const float tan_y = std::tan(0.5F * kFramingFov);
        framing = frameBox(bounds, axes, width_per_height * tan_y, tan_y);
    }
    const vec3 far_out = glm::abs(centre);
    const float resolved = kResolvedShare * std::max({far_out.x, far_out.y, far_out.z});
    const float moved = std::max(0.0F, resolved - framing.distance);
    framing.distance += moved;
    framing.nearest += moved;

    Camera camera;
    camera.name = "framing";
    camera.y_fov = kFramingFov;
    camera.world_from_view = mat4(axes);
    camera.world_from_view[3] = vec4(centre + framing.distance * back, 1.0F);
    camera.z_near = std::min(kNearShare * framing.distance, 0.5F * framing.nearest);
    return camera;
}

bool fillsAngle(const PunctualLight& light) {
    return light.kind == PunctualLight::Kind::directional &&
           light.angular_diameter >= kSmallestAngularDiameter;
}

Environment constantEnvironment(const vec3& radiance) {
    Environment environment;
    environment.name = "constant";
    environment.radiance = Image(1, 1, 3);
    for (int channel = 0; channel < 3; ++channel) {
        environment.radiance.at(0, 0, channel) = radiance[channel];
    }
    return environment;
}

}  // namespace licht
