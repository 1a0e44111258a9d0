#pragma once
#include <vector>

#include "licht/run/path_frame.h"
#include "samples/licht/scene_source.h"

namespace licht {

/// Gives the frames, of which there are so many a second, the scene as it is at their time, where it moves.
void addScenes(std::vector<PathFrame>& path, const NamedScene& source, const SceneRequest& request,
               double rate);

}  // namespace licht
