// The library in 40 lines: a lit square over a floor, or a glTF file, to minimal.png.
#include <cstdio>
#include <exception>
#include <vector>

#include "licht/image/files.h"
#include "licht/run/plan.h"
#include "licht/run/render_loop.h"
#include "licht/scene/gltf.h"
#include "licht/settings/settings.h"

using namespace licht;

static Scene lampOverFloor() {
    Scene scene;
    scene.materials.resize(2);
    scene.materials[0].metallic = 0.0F;
    scene.materials[1].emission = vec3(10.0F);  // cd/m^2
    Mesh square;
    square.positions = {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}};  // seen from above
    square.triangles = {{0, 1, 2}, {0, 2, 3}};
    scene.meshes.assign(2, square);
    scene.meshes[1].material = 1;
    const mat4 flipped = glm::rotate(glm::translate(mat4(1.0F), vec3(0, 1.5F, 0)), kPi, vec3(1, 0, 0));
    scene.instances = {{"floor", 0, glm::scale(mat4(1.0F), vec3(2.0F))},
                       {"lamp", 1, glm::scale(flipped, vec3(0.25F))}};
    return scene;
}

int main(int argument_count, char** arguments) try {
    const Scene scene = argument_count > 1 ? loadGltf(arguments[1]) : lampOverFloor();
    RunSettings run;
    run.render.size = {320, 180};
    run.samples = 16;
    const Camera camera =
        scene.cameras.empty() ? framingCamera(sceneBounds(scene), 16.0F / 9.0F) : scene.cameras[0];
    gpu::Device device(gpu::DeviceOptions{});
    const RunPlan plan = planRun(device, scene, camera, run);
    Renderer renderer(device, scene, camera, plan.settings);
    const LoopResult result = renderUntil(renderer, plan.settings, plan.rules);
    writePng("minimal.png", renderer.readDisplay(Tonemap::neutral, 0.0F));
    std::printf("minimal.png: 16 samples, relative error %.3f\n", result.error);
} catch (const std::exception& error) {
    std::fprintf(stderr, "minimal: %s\n", error.what());
    return 1;
}
