#include "licht/run/disocclusion.h"

#include <cmath>

namespace licht {
namespace {

/// Of the distance: what lies no farther behind may be the same surface, seen aslant.
constexpr float kBehind = 0.02F;

vec3 positionAt(const SeenDepths& seen, int x, int y, float depth) {
    const ViewRecord& view = seen.view;
    const vec2 ndc = 2.0F * (vec2(x, y) + 0.5F) / vec2(view.size) - 1.0F;
    const float reach = view.orthographic != 0 ? 1.0F : depth;
    return view.eye - depth * view.back +
           reach * (ndc.x * view.scale_x * view.right - ndc.y * view.scale_y * view.up);
}

std::uint32_t placeBefore(const SeenDepths& before, const vec3& position) {
    const ViewRecord& view = before.view;
    const vec3 relative = position - view.eye;
    const float depth = -glm::dot(view.back, relative);
    if (!(depth > 0.0F)) return kNotSeen;
    const float reach = view.orthographic != 0 ? 1.0F : depth;
    const vec2 ndc(glm::dot(view.right, relative) / (view.scale_x * reach),
                   -glm::dot(view.up, relative) / (view.scale_y * reach));
    const vec2 place = (ndc * 0.5F + 0.5F) * vec2(view.size);
    if (!(place.x >= 0.0F && place.y >= 0.0F && place.x < static_cast<float>(view.size.x) &&
          place.y < static_cast<float>(view.size.y)))
        return kNotSeen;
    const uvec2 pixel(place);
    const std::uint32_t number = pixel.y * view.size.x + pixel.x;
    return before.depth.texels[number] > (1.0F - kBehind) * depth ? number : kNotSeen;
}

}  // namespace

std::vector<std::uint32_t> findBefore(const SeenDepths& before, const SeenDepths& now) {
    std::vector<std::uint32_t> places;
    places.reserve(now.depth.texels.size());
    for (int y = 0; y < now.depth.height; ++y) {
        for (int x = 0; x < now.depth.width; ++x) {
            const float depth = now.depth.at(x, y, 0);
            const auto itself = static_cast<std::uint32_t>(places.size());
            places.push_back(std::isfinite(depth) ? placeBefore(before, positionAt(now, x, y, depth))
                                                  : itself);
        }
    }
    return places;
}

}  // namespace licht
