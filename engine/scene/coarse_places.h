#pragma once
#include "licht/scene/scene.h"

namespace licht {

/// One warning where instances, or the vertices of their meshes, stand so far from the origin for their size
/// that the steps between floats are coarse: surfaces then lie beside where they should, and rays that leave
/// them may meet them again.
void warnOfCoarsePlaces(Scene& scene);

}  // namespace licht
