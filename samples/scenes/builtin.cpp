#include "licht/scenes/builtin.h"

#include <algorithm>
#include <array>

#include "licht/scenes/builtin_scenes.h"

namespace licht {
namespace {

struct Entry {
    BuiltinScene scene;
    Scene (*make)();
};

constexpr std::array kTable{
    Entry{{"gallery", "a room lit by daylight and lamps: the demo"}, makeGallery},
    Entry{{"cornell", "the Cornell box, from its measured data"}, makeCornell},
    Entry{{"furnace", "closed and uniform: everything emits and reflects one half"}, makeFurnace},
    Entry{{"empty", "a camera and nothing else"}, makeEmpty},
};

}  // namespace

const std::vector<BuiltinScene>& builtinScenes() {
    static const std::vector<BuiltinScene> scenes = [] {
        std::vector<BuiltinScene> list;
        for (const Entry& entry : kTable) list.push_back(entry.scene);
        return list;
    }();
    return scenes;
}

std::optional<Scene> makeBuiltinScene(std::string_view name) {
    const auto* const entry =
        std::find_if(kTable.begin(), kTable.end(), [name](const Entry& e) { return e.scene.name == name; });
    if (entry == kTable.end()) return std::nullopt;
    return entry->make();
}

}  // namespace licht
