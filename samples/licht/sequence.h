#pragma once
#include "samples/licht/options.h"

namespace licht {

/// `licht render --path`: a picture for each frame of a camera's path, as the viewer would show it. Throws
/// InputError or DeviceError; otherwise the exit code.
int renderSequence(const RenderOptions& options);

}  // namespace licht
