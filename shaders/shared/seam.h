// The seam between C++ and GLSL: the only place where the two languages need different words.
#ifndef LICHT_SHARED_SEAM_H
#define LICHT_SHARED_SEAM_H

#ifdef __cplusplus
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#define LICHT_SHARED_BEGIN      \
    namespace licht {           \
    using uint = std::uint32_t; \
    using glm::mat4;            \
    using std::pow;             \
    using glm::uvec2;           \
    using glm::uvec3;           \
    using glm::uvec4;           \
    using glm::vec2;            \
    using glm::vec3;            \
    using glm::vec4;
#define LICHT_SHARED_END }
#define LICHT_CONSTANT inline constexpr
#define LICHT_FUNCTION inline
#define LICHT_ASSERT(condition) static_assert(condition)
#else
#define LICHT_SHARED_BEGIN
#define LICHT_SHARED_END
#define LICHT_CONSTANT const
#define LICHT_FUNCTION
#define LICHT_ASSERT(condition)
#endif

#endif
