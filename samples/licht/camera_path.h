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

/// Whether a path is read from the file of its name.
bool isPathFile(const PathRequest& request);

/// `start`: from where the scene is seen first; files take from it what they do not say. Throws InputError,
/// naming file and key, where a file is no path (samples/licht/README.md, "Camera paths"), and where one of
/// its views cannot be drawn in that size.
std::vector<PathFrame> followPath(const PathRequest& request, const NamedScene& source, const Shot& start);

}  // namespace licht
