#pragma once
// Scenes that are made in code, so that the program has something to draw wherever it runs.
#include <optional>
#include <string_view>
#include <vector>

#include "licht/scene/scene.h"

namespace licht {

struct BuiltinScene {
    std::string_view name;
    std::string_view meaning;  ///< one line for --help
};

/// cornell, furnace, gallery, empty.
const std::vector<BuiltinScene>& builtinScenes();

/// The scene of that name, or nullopt.
std::optional<Scene> makeBuiltinScene(std::string_view name);

}  // namespace licht
