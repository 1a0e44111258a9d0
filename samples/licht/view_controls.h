#pragma once
#include "licht/settings/settings.h"
#include "licht/window/window.h"
#include "samples/licht/options.h"
#include "samples/licht/orbit_camera.h"

namespace licht {

/// What the hand at the window can change.
struct ViewState {
    OrbitCamera orbit;
    double exposure = 0.0;  ///< EV
    Tonemap tonemap = Tonemap::neutral;
    bool quit = false;
};

/// The state after these motions and keys. `start` is what R returns to; `height` is the window's.
ViewState applyInput(ViewState state, const ViewState& start, const InputState& input, float height);

}  // namespace licht
