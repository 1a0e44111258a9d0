#include "licht/render/view.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "licht/core/error.h"

namespace licht {

ViewRecord makeView(const Camera& camera, uvec2 size, const Bounds& bounds) {
    ViewRecord view{};
    view.eye = vec3(camera.world_from_view[3]);
    view.right = glm::normalize(vec3(camera.world_from_view[0]));
    view.up = glm::normalize(vec3(camera.world_from_view[1]));
    view.back = glm::normalize(vec3(camera.world_from_view[2]));
    const bool orthographic = camera.kind == Camera::Kind::orthographic;
    view.orthographic = orthographic ? 1U : 0U;
    view.scale_y = orthographic ? camera.y_extent : std::tan(0.5F * camera.y_fov);
    // Below, directions of neighbouring pixels are the same floats.
    if (!orthographic && !(view.scale_y >= 0x1p-24F * static_cast<float>(size.y)))
        throw InputError(
            fmt::format("camera '{}': its vertical angle of {} radians is too narrow for {} pixels",
                        camera.name, camera.y_fov, size.y));
    view.scale_x = view.scale_y * static_cast<float>(size.x) / static_cast<float>(size.y);
    view.z_near = camera.z_near;
    const float reach = bounds.empty() ? 1.0F : glm::length(bounds.centre() - view.eye) + bounds.radius();
    view.z_far = std::max(2.0F * reach, 2.0F * camera.z_near + 1.0F);
    view.z_limit = camera.z_far > 0.0F ? camera.z_far : std::numeric_limits<float>::infinity();
    view.size = size;
    return view;
}

}  // namespace licht
