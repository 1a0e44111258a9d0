#pragma once
#include "licht/render/renderer.h"
#include "licht/scene/scene.h"

namespace licht {

/// A frame of a camera's path: what it is seen by, and how that follows the frame before.
struct PathFrame {
    Camera camera;
    ViewChange change = ViewChange::motion;
};

}  // namespace licht
