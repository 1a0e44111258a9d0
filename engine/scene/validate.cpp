// What every consumer of a Scene relies on.
#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "licht/core/error.h"
#include "licht/scene/material_numbers.h"
#include "licht/scene/scene.h"

namespace licht {
namespace {

void require(bool holds, std::string_view kind, std::size_t index, std::string_view name,
             std::string_view reason) {
    if (!holds) {
        throw InputError(fmt::format("scene: {} {} '{}': {}", kind, index, name, reason));
    }
}

bool finite(float x) {
    return std::isfinite(x);
}
bool finite(const vec3& v) {
    return finite(v.x) && finite(v.y) && finite(v.z);
}
bool finite(const vec4& v) {
    return finite(vec3(v)) && finite(v.w);
}
bool finite(const mat4& m) {
    return finite(m[0]) && finite(m[1]) && finite(m[2]) && finite(m[3]);
}
bool inUnit(float x) {
    return x >= 0.0F && x <= 1.0F;
}
bool notNegative(const vec3& v) {
    return finite(v) && v.x >= 0.0F && v.y >= 0.0F && v.z >= 0.0F;
}

void validateTextures(const Scene& scene) {
    for (std::size_t i = 0; i < scene.textures.size(); ++i) {
        const Texture& t = scene.textures[i];
        require(t.bits == 8 || t.bits == 16, "texture", i, t.name, "bits per channel are neither 8 nor 16");
        require(t.width > 0 && t.height > 0, "texture", i, t.name, "it has no texels");
        require(t.bytes.size() == std::size_t{t.width} * t.height * 4 * (t.bits / 8), "texture", i, t.name,
                "its bytes do not match its size");
    }
}

void validateMaterials(const Scene& scene) {
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& m = scene.materials[i];
        require(finite(m.base_color) && notNegative(vec3(m.base_color)) && m.base_color.w >= 0.0F, "material",
                i, m.name, "the base colour is negative or not finite");
        require(inUnit(m.metallic) && inUnit(m.roughness), "material", i, m.name,
                "metallic or roughness lies outside [0,1]");
        require(notNegative(m.emission) && notNegative(m.specular_color), "material", i, m.name,
                "emission or specular colour is negative or not finite");
        require(finite(m.normal_scale) && finite(m.alpha_cutoff), "material", i, m.name,
                "normal scale or alpha cutoff is not finite");
        require(m.ior == 0.0F || (m.ior >= 1.0F && finite(m.ior)), "material", i, m.name,
                "the index of refraction is neither 0 nor at least 1");
        Material copy = m;
        for (const MaterialNumber& row : kMaterialNumbers) {
            const float value = row.of(copy);
            require(value >= row.least && value <= row.most, "material", i, m.name,
                    fmt::format("{} lies outside [{}, {}]", row.key, row.least, row.most));
        }
        for (const TextureSlot& slot : m.slots) {
            require(!slot.present() || slot.texture < scene.textures.size(), "material", i, m.name,
                    "it names a texture that is not there");
            require(finite(slot.u_from_uv) && finite(slot.v_from_uv), "material", i, m.name,
                    "a texture transform is not finite");
        }
    }
}

void validateMeshes(const Scene& scene) {
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        const Mesh& m = scene.meshes[i];
        const std::size_t n = m.positions.size();
        const auto fits = [n](const auto& values) { return values.empty() || values.size() == n; };
        require(fits(m.normals) && fits(m.tangents) && fits(m.colors), "mesh", i, m.name,
                "an attribute is not as long as its positions");
        for (const auto& uvs : m.uv_sets) {
            require(fits(uvs), "mesh", i, m.name,
                    "a set of texture coordinates is not as long as its positions");
        }
        for (const uvec3& t : m.triangles) {
            require(t.x < n && t.y < n && t.z < n, "mesh", i, m.name,
                    "a triangle names a vertex that is not there");
        }
        require(m.material < scene.materials.size(), "mesh", i, m.name,
                "it names a material that is not there");
    }
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        require(instance.mesh < scene.meshes.size(), "instance", i, instance.name,
                "it names a mesh that is not there");
        require(finite(instance.world_from_object), "instance", i, instance.name,
                "its transform is not finite");
    }
}

void validateViews(const Scene& scene) {
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
        const Camera& c = scene.cameras[i];
        require(finite(c.world_from_view), "camera", i, c.name, "its transform is not finite");
        require(c.kind != Camera::Kind::perspective || (c.y_fov > 0.0F && c.y_fov < kPi), "camera", i, c.name,
                "its vertical angle lies outside (0, pi)");
        require(c.kind != Camera::Kind::orthographic || (c.y_extent > 0.0F && finite(c.y_extent)), "camera",
                i, c.name, "its half height is not positive");
        require(c.z_far == 0.0F || (c.z_far > c.z_near && finite(c.z_far)), "camera", i, c.name,
                "its far plane is not behind its near plane");
        require(c.z_near >= 0.0F && finite(c.z_near) && c.aspect >= 0.0F && finite(c.aspect), "camera", i,
                c.name, "its near plane or aspect ratio is negative or not finite");
    }
}

void validateLights(const Scene& scene) {
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const PunctualLight& l = scene.lights[i];
        require(notNegative(l.intensity), "light", i, l.name, "its intensity is negative or not finite");
        require(finite(l.position), "light", i, l.name, "its position is not finite");
        // Three roundings of half an ulp each leave a normalised vector's length within 4 ulp of one.
        require(std::abs(glm::length(l.direction) - 1.0F) <= 4.0F * std::numeric_limits<float>::epsilon(),
                "light", i, l.name, "its direction is not a unit vector");
        require(l.inner_cone >= 0.0F && l.inner_cone <= l.outer_cone && l.outer_cone <= 0.5F * kPi, "light",
                i, l.name, "its cone angles do not rise from 0 to at most pi/2");
        require(l.range >= 0.0F, "light", i, l.name, "its range is negative or not a number");
        require(l.angular_diameter >= 0.0F && l.angular_diameter <= kPi, "light", i, l.name,
                "the angle that it fills lies outside [0, pi]");
    }
    if (scene.environment) {
        const Image& map = scene.environment->radiance;
        require(map.width > 0 && map.height > 0 && map.channels == 3, "environment", 0,
                scene.environment->name, "it is no map of three channels");
        require(map.texels.size() == std::size_t{3} * static_cast<std::size_t>(map.width) *
                                         static_cast<std::size_t>(map.height),
                "environment", 0, scene.environment->name, "its texels do not match its size");
    }
}

}  // namespace

void validateScene(const Scene& scene) {
    validateTextures(scene);
    validateMaterials(scene);
    validateMeshes(scene);
    validateViews(scene);
    validateLights(scene);
}

}  // namespace licht
