#pragma once
// Paths that a camera follows, frame by frame: built-in ones and those of files.
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "licht/run/path_frame.h"
#include "licht/scene/scene.h"
#include "samples/licht/scene_source.h"

namespace licht {

struct BuiltinPath {
    std::string_view name;
    std::string_view meaning;
};
/// In any scene: they begin at the camera that was chosen.
std::span<const BuiltinPath> builtinPaths();

/// `start`: the camera that was chosen; files take from it what they do not say. Throws InputError, naming
/// file and key, where a file is no path (samples/licht/README.md, "Camera paths").
std::vector<PathFrame> followPath(const PathRequest& request, const NamedScene& source, const Camera& start);

}  // namespace licht
