// A furnace: every surface is Lambertian with albedo r and emits Le, and the space is closed. Whatever its
// form, the radiance after n bounces is the same everywhere in every direction: Le (1 - r^(n+1)) / (1 - r).
#include <utility>

#include "samples/scenes/assembly.h"
#include "samples/scenes/builtin_scenes.h"
#include "samples/scenes/shapes.h"

namespace licht {

Scene makeFurnace() {
    Scene scene;
    scene.name = "furnace";
    Material material;
    material.name = "furnace";
    material.base_color = vec4(vec3(0.5F), 1.0F);
    material.emission = vec3(0.5F);
    material.metallic = 0.0F;
    material.specular = 0.0F;
    const std::uint32_t uniform = addMaterial(scene, material);

    const vec3 one{1.0F};
    Mesh room = boxMesh("room", uniform, -one, one);
    for (uvec3& triangle : room.triangles) std::swap(triangle.y, triangle.z);
    place(scene, std::move(room));
    place(scene, sphereMesh("sphere", uniform, 0.45F, 24, 12), moved({-0.3F, -0.4F, -0.35F}));
    place(scene, roundedBoxMesh("block", uniform, vec3(0.4F, 0.9F, 0.4F), 0.1F),
          moved({0.45F, -0.35F, -0.2F}, 0.4F));
    // Flat shading: an interpolated normal would lose the part of its hemisphere that is below the face.
    for (Mesh& mesh : scene.meshes) mesh.normals.clear();

    scene.cameras.push_back(lookingCamera("inside", vec3(0.1F, 0.2F, 0.9F), vec3(0.0F, -0.2F, 0.0F), 1.2F));
    return scene;
}

}  // namespace licht
