#pragma once
#include <string>

#include "licht/scene/scene.h"

namespace licht {

/// What is in a scene: counts, textures and their bytes, cameras, lights, bounds, what was skipped or changed
/// and why, and which effects it calls for, each with the object that called. For people.
std::string describeSceneText(const Scene& scene);

/// The same as a JSON object.
std::string describeSceneJson(const Scene& scene);

}  // namespace licht
