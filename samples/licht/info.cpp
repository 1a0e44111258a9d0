#include <fmt/format.h>

#include "licht/command/commands.h"
#include "licht/command/scene_source.h"
#include "licht/scene/describe.h"

namespace licht {

int info(const InfoOptions& options) {
    const Scene scene = loadNamedScene(options.scene).scene;
    const std::string text = options.json ? describeSceneJson(scene) : describeSceneText(scene);
    fmt::print("{}{}", text, text.empty() || text.back() != '\n' ? "\n" : "");
    return 0;
}

}  // namespace licht
