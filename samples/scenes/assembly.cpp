#include "samples/scenes/assembly.h"

#include <utility>

namespace licht {

std::uint32_t addTexture(Scene& scene, Texture texture) {
    scene.textures.push_back(std::move(texture));
    return static_cast<std::uint32_t>(scene.textures.size() - 1);
}

std::uint32_t addMaterial(Scene& scene, Material material) {
    scene.materials.push_back(std::move(material));
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

std::uint32_t addMesh(Scene& scene, Mesh mesh) {
    scene.meshes.push_back(std::move(mesh));
    return static_cast<std::uint32_t>(scene.meshes.size() - 1);
}

Material matte(std::string name, const vec3& reflectance) {
    Material material;
    material.name = std::move(name);
    material.base_color = vec4(reflectance, 1.0F);
    material.metallic = 0.0F;
    material.specular = 0.0F;
    return material;
}

void place(Scene& scene, std::uint32_t mesh, const mat4& world_from_object) {
    scene.instances.push_back({scene.meshes[mesh].name, mesh, world_from_object});
}

void place(Scene& scene, Mesh mesh, const mat4& world_from_object) {
    place(scene, addMesh(scene, std::move(mesh)), world_from_object);
}

mat4 moved(const vec3& position, float yaw) {
    return glm::rotate(glm::translate(mat4(1.0F), position), yaw, vec3(0, 1, 0));
}

Camera lookingCamera(std::string name, const vec3& eye, const vec3& target, float y_fov) {
    Camera camera;
    camera.name = std::move(name);
    camera.world_from_view = glm::inverse(glm::lookAt(eye, target, vec3(0, 1, 0)));
    camera.y_fov = y_fov;
    return camera;
}

}  // namespace licht
