#include "samples/licht/scene_in_time.h"

namespace licht {

void addScenes(std::vector<PathFrame>& path, const NamedScene& source, const SceneRequest& request,
               double rate) {
    if (!moves(source)) return;
    for (std::size_t frame = 0; frame < path.size(); ++frame)
        path[frame].scene = [request, seconds = static_cast<double>(frame) / rate] {
            return loadScene(request, seconds).scene;
        };
}

}  // namespace licht
