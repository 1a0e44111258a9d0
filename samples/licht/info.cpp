#include "licht/scene/describe.h"
#include "samples/licht/commands.h"
#include "samples/licht/outputs.h"
#include "samples/licht/scene_source.h"

namespace licht {

int info(const InfoOptions& options) {
    const Scene scene = loadNamedScene(options.source).scene;
    printOut(options.json ? describeSceneJson(scene) : describeSceneText(scene));
    return 0;
}

}  // namespace licht
