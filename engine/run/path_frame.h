#pragma once
#include <functional>

#include "licht/render/renderer.h"
#include "licht/scene/scene.h"

namespace licht {

/// A frame of a camera's path: what it is seen by, and how that follows the frame before.
struct PathFrame {
    Camera camera;
    ViewChange change = ViewChange::motion;
    std::function<Scene()> scene{};  ///< makes it as it is then; empty: it does not move
};

/// What the renderer's next sample is of. Its settings must let the scene move where the frame has one.
inline void showFrame(Renderer& renderer, const PathFrame& frame) {
    if (frame.scene) renderer.setScene(frame.scene(), frame.change);
    renderer.setCamera(frame.camera, frame.change);
}

}  // namespace licht
