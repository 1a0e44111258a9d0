#include "samples/scenes/builtin.h"

#include <algorithm>
#include <array>

#include "samples/scenes/builtin_scenes.h"

namespace licht {
namespace {

struct Entry {
    BuiltinScene scene;
    Scene (*make)(std::uint64_t triangles, double seconds);
};

template <Scene (*make)()>
Scene fixed(std::uint64_t /*triangles*/, double /*seconds*/) {
    return make();
}

template <Scene (*make)(std::uint64_t)>
Scene counted(std::uint64_t triangles, double /*seconds*/) {
    return make(triangles);
}

Scene moving(std::uint64_t /*triangles*/, double seconds) {
    return makeMoving(seconds);
}

constexpr std::array kTable{
    Entry{{"gallery", "a room lit by daylight and lamps: the demo"}, fixed<makeGallery>},
    Entry{{"cornell", "the Cornell box, from its measured data"}, fixed<makeCornell>},
    Entry{{"furnace", "closed and uniform: everything emits and reflects one half"}, fixed<makeFurnace>},
    Entry{{"terrain", "mountains and boulders in the sun, of as many triangles as --triangles says", 100'000},
          counted<makeTerrain>},
    Entry{
        {"spheres", "spheres of many sizes under a lamp, of as many triangles as --triangles says", 100'000},
        counted<makeSpheres>},
    Entry{{"lamps", "a hall of some 200 small lamps, more where --triangles says how many triangles shine",
           3'000},
          counted<makeLamps>},
    Entry{{"meadow", "100,000 plants of three kinds, each kind stored once"}, fixed<makeMeadow>},
    Entry{{"moving", "a room where a box, a flag and lamps move: it is drawn at time 0, or along a path", 0,
           true},
          moving},
    Entry{{"empty", "a camera and nothing else"}, fixed<makeEmpty>},
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

std::optional<Scene> makeBuiltinScene(std::string_view name, std::uint64_t triangles, double seconds) {
    const auto* const entry =
        std::find_if(kTable.begin(), kTable.end(), [name](const Entry& e) { return e.scene.name == name; });
    if (entry == kTable.end()) return std::nullopt;
    return entry->make(triangles == 0 ? entry->scene.triangles : triangles, seconds);
}

}  // namespace licht
