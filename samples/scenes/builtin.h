#pragma once
// Scenes that are made in code, so that the program has something to draw wherever it runs.
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "licht/scene/scene.h"

namespace licht {

/// What may be asked of a scene whose triangles are counted. It has at most 1 % more or fewer than asked for;
/// of `lamps` those that shine are counted.
inline constexpr std::uint64_t kFewestTriangles = 1'000;
inline constexpr std::uint64_t kMostTriangles = 16'000'000;

struct BuiltinScene {
    std::string_view name;
    std::string_view meaning;     ///< one line for --help
    std::uint64_t triangles = 0;  ///< how many it has unless asked for another count; 0: it takes no count
    bool moves = false;           ///< it is another at another time
};

/// cornell, furnace, gallery, terrain, spheres, lamps, meadow, moving, empty.
const std::vector<BuiltinScene>& builtinScenes();

/// The scene of that name, or nullopt. `triangles` is heeded by scenes that take a count; 0: their own;
/// `seconds` by those that move.
std::optional<Scene> makeBuiltinScene(std::string_view name, std::uint64_t triangles = 0,
                                      double seconds = 0.0);

}  // namespace licht
