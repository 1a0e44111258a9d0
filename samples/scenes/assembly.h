#pragma once
// Putting a scene together: adding its parts, placing meshes, aiming a camera. Lengths are metres, angles
// radians.
#include <cstdint>
#include <string>

#include "licht/scene/scene.h"

namespace licht {

/// Adds to a scene and gives the index.
std::uint32_t addTexture(Scene& scene, Texture texture);
std::uint32_t addMaterial(Scene& scene, Material material);
std::uint32_t addMesh(Scene& scene, Mesh mesh);

/// Lambertian: what scatters evenly and mirrors nothing.
Material matte(std::string name, const vec3& reflectance);

/// Places a mesh that is there already, under the mesh's name.
void place(Scene& scene, std::uint32_t mesh, const mat4& world_from_object = mat4(1.0F));
/// Adds a mesh and places it once.
void place(Scene& scene, Mesh mesh, const mat4& world_from_object = mat4(1.0F));

/// Turns by `yaw` around +Y, then moves.
mat4 moved(const vec3& position, float yaw = 0.0F);

/// A camera at `eye` looking at `target`, +Y up.
Camera lookingCamera(std::string name, const vec3& eye, const vec3& target, float y_fov);

}  // namespace licht
