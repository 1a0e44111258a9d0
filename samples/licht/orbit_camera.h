#pragma once
#include "licht/core/math.h"
#include "licht/scene/scene.h"

namespace licht {

/// A camera that turns about a point. A plain value: every motion is a function of it and the hand's move,
/// and nothing else.
class OrbitCamera {
public:
    /// Starts exactly at `camera`; the point it turns about lies on its axis, at the depth of the bounds'
    /// centre.
    OrbitCamera(const Camera& camera, const Bounds& bounds);

    /// Turns by these angles in radians: about the world's up axis, then about the camera's right axis.
    /// Looking straight up or down is not passed.
    void orbit(float yaw, float pitch);
    /// Moves parallel to the picture, in picture heights, so that the point turned about follows the hand.
    void pan(float right, float up);
    /// Comes nearer by that factor (0.5: half the distance) without reaching the point turned about.
    void dolly(float factor);
    /// Walks along the camera's own axes, in units of the distance to the point turned about.
    void walk(float right, float forward);

    [[nodiscard]] const Camera& camera() const { return camera_; }

private:
    void place();
    Camera camera_;
    vec3 target_{0.0F};
    float distance_ = 1.0F;
    mat3 world_from_view_{1.0F};  ///< unit axes
};

}  // namespace licht
