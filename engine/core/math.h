#pragma once
// The GLM settings of the whole engine, and the two geometric values everybody speaks of: Ray and Bounds.
#ifndef GLM_FORCE_DEPTH_ZERO_TO_ONE
#define GLM_FORCE_DEPTH_ZERO_TO_ONE
#endif
#ifndef GLM_ENABLE_EXPERIMENTAL
#define GLM_ENABLE_EXPERIMENTAL
#endif
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <numbers>

namespace licht {

using glm::mat3;
using glm::mat4;
using glm::quat;
using glm::uvec2;
using glm::uvec3;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;

inline constexpr float kPi = std::numbers::pi_v<float>;
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Whether a transform turns what is counter-clockwise clockwise.
inline bool mirrors(const mat4& m) {
    return glm::dot(vec3(m[0]), glm::cross(vec3(m[1]), vec3(m[2]))) < 0.0F;
}

/// Points origin + t * direction for t in the half-open range [t_min, t_max). The direction need not have
/// length one.
struct Ray {
    vec3 origin{0.0F};
    vec3 direction{0.0F, 0.0F, -1.0F};
    float t_min = 0.0F;
    float t_max = kInfinity;
};

/// An axis-aligned box; the default is empty (lower > upper).
struct Bounds {
    vec3 lower{kInfinity};
    vec3 upper{-kInfinity};

    void extend(const vec3& point) {
        lower = glm::min(lower, point);
        upper = glm::max(upper, point);
    }
    void extend(const Bounds& other) {
        lower = glm::min(lower, other.lower);
        upper = glm::max(upper, other.upper);
    }
    [[nodiscard]] bool empty() const {
        return !(lower.x <= upper.x && lower.y <= upper.y && lower.z <= upper.z);
    }
    [[nodiscard]] vec3 centre() const { return 0.5F * lower + 0.5F * upper; }
    [[nodiscard]] vec3 size() const { return empty() ? vec3(0.0F) : upper - lower; }
    /// Half of the surface area, the measure the surface area heuristic compares.
    [[nodiscard]] float halfArea() const {
        const vec3 s = size();
        return s.x * s.y + s.y * s.z + s.z * s.x;
    }
    /// Radius of the sphere around centre() that holds the box.
    [[nodiscard]] float radius() const { return 0.5F * glm::length(size()); }
};

}  // namespace licht
