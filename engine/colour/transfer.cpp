#include "licht/colour/transfer.h"

namespace licht {

float luminance(const vec3& linear) {
    return glm::dot(linear, vec3(0.2126F, 0.7152F, 0.0722F));
}

}  // namespace licht
