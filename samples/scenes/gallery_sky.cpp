#include <cmath>

#include "samples/scenes/gallery.h"
#include "samples/scenes/pattern.h"

namespace licht::gallery {
namespace {

constexpr std::uint32_t kWidth = 512;
constexpr std::uint32_t kHeight = 256;

/// Towards the sun: out of the window, a little beyond the room's far end.
const vec3 kSun = glm::normalize(vec3(-0.66F, 0.60F, -0.45F));
/// Wider than the real sun, so that its disc covers several texels and its shadows are soft.
constexpr float kSunRadius = 0.035F;

vec3 skyRadiance(const vec3& direction, float longitude) {
    const float toward_sun = glm::dot(direction, kSun);
    const float hills = 0.02F + 0.16F * fractalNoise({longitude, 0.5F}, {14, 1}, 3, 81);
    // The land in front of the window lies in the haze of the evening; behind the house all is dimmer.
    const float lit_side = 0.12F + 0.88F * softStep(-0.7F, 0.5F, toward_sun);
    if (direction.y < hills) {
        const float near = softStep(hills, -0.5F, direction.y);
        return lit_side * glm::mix(vec3(0.62F, 0.78F, 0.88F), vec3(0.22F, 0.27F, 0.16F), near);
    }
    const float height = softStep(0.0F, 0.7F, direction.y);
    vec3 sky = lit_side * glm::mix(vec3(3.6F, 4.0F, 4.5F), vec3(1.1F, 2.3F, 4.6F), height);
    const float glow = std::exp(-9.0F * (1.0F - toward_sun));
    sky += glow * vec3(4.0F, 2.8F, 1.4F);
    const float angle = std::acos(glm::clamp(toward_sun, -1.0F, 1.0F));
    sky += (1.0F - softStep(0.7F * kSunRadius, 1.3F * kSunRadius, angle)) * vec3(4200.0F, 3400.0F, 2450.0F);
    return sky;
}

}  // namespace

Environment afternoonSky() {
    return paintSky("late afternoon", kWidth, kHeight, skyRadiance);
}

}  // namespace licht::gallery
