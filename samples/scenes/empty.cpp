#include "samples/scenes/assembly.h"
#include "samples/scenes/builtin_scenes.h"

namespace licht {

Scene makeEmpty() {
    Scene scene;
    scene.name = "empty";
    scene.cameras.push_back(lookingCamera("camera", vec3(0, 0, 1), vec3(0.0F), 0.8F));
    return scene;
}

}  // namespace licht
