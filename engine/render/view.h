#pragma once
#include "licht/scene/scene.h"
#include "licht/shared/frame.h"

namespace licht {

/// The camera as the shaders see it. The picture keeps the camera's vertical extent; its own aspect ratio
/// rules the horizontal one. `bounds` gives an orthographic camera its far plane.
ViewRecord makeView(const Camera& camera, uvec2 size, const Bounds& bounds);

}  // namespace licht
