#include "samples/licht/orbit_camera.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace licht {
namespace {

constexpr vec3 kWorldUp{0.0F, 1.0F, 0.0F};
constexpr float kSteepest =
    0.5F * kPi - 0.01F;  ///< radians above or below the horizon; at the pole the horizon has no direction

/// The camera's axes without the scale or mirroring that a node may bring.
mat3 unitAxes(const mat4& world_from_view) {
    const vec3 back = glm::normalize(vec3(world_from_view[2]));
    const vec3 right = glm::normalize(glm::cross(vec3(world_from_view[1]), back));
    return {right, glm::cross(back, right), back};
}

mat3 rotation(float angle, const vec3& axis) {
    return mat3(glm::rotate(mat4(1.0F), angle, axis));
}

}  // namespace

OrbitCamera::OrbitCamera(const Camera& camera, const Bounds& bounds)
    : camera_(camera), world_from_view_(unitAxes(camera.world_from_view)) {
    const vec3 eye = vec3(camera.world_from_view[3]);
    const vec3 forward = -world_from_view_[2];
    if (!bounds.empty()) {
        const float depth = glm::dot(bounds.centre() - eye, forward);
        // Behind the camera or closer than a hundredth of the scene there is nothing to turn about: take the
        // scene's own scale.
        const float smallest = 0.01F * bounds.radius();
        distance_ = depth > smallest ? depth : std::max(bounds.radius(), smallest);
        if (!(distance_ > 0.0F)) distance_ = 1.0F;
    }
    target_ = eye + distance_ * forward;
}

void OrbitCamera::orbit(float yaw, float pitch) {
    const vec3 forward = -world_from_view_[2];
    const float elevation = std::asin(std::clamp(forward.y, -1.0F, 1.0F));
    // A camera that starts steeper may come back but not go on.
    const float limit = std::max(kSteepest, std::abs(elevation));
    const float allowed = std::clamp(elevation + pitch, -limit, limit) - elevation;
    world_from_view_ = rotation(yaw, kWorldUp) * rotation(allowed, world_from_view_[0]) * world_from_view_;
    world_from_view_ = unitAxes(mat4(world_from_view_));
    place();
}

void OrbitCamera::pan(float right, float up) {
    const bool orthographic = camera_.kind == Camera::Kind::orthographic;
    const float picture_height =
        2.0F * (orthographic ? camera_.y_extent : distance_ * std::tan(0.5F * camera_.y_fov));
    target_ -= picture_height * (right * world_from_view_[0] + up * world_from_view_[1]);
    place();
}

void OrbitCamera::dolly(float factor) {
    assert(factor > 0.0F);
    distance_ *= factor;
    if (camera_.kind == Camera::Kind::orthographic) camera_.y_extent *= factor;
    place();
}

void OrbitCamera::walk(float right, float forward) {
    target_ += distance_ * (right * world_from_view_[0] - forward * world_from_view_[2]);
    place();
}

void OrbitCamera::place() {
    camera_.world_from_view = mat4(world_from_view_);
    camera_.world_from_view[3] = vec4(target_ + distance_ * world_from_view_[2], 1.0F);
}

}  // namespace licht
