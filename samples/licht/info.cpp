#include <fmt/format.h>

#include "licht/scene/describe.h"
#include "samples/licht/commands.h"
#include "samples/licht/scene_source.h"

namespace licht {

int info(const InfoOptions& options) {
    const Scene scene = loadNamedScene(options.scene).scene;
    const std::string text = options.json ? describeSceneJson(scene) : describeSceneText(scene);
    fmt::print("{}{}", text, text.empty() || text.back() != '\n' ? "\n" : "");
    return 0;
}

}  // namespace licht
