#pragma once
// A scene as plain values, independent of any file format and any device.
//
// Units are glTF's: metres; luminance-like quantities (emission, skies) in cd/m^2; point and spot lights in
// candela; directional lights in lux. They meet without a factor: a light of I candela at distance r gives I
// cos(theta) / r^2 lux, and a Lambertian surface of albedo rho under E lux has rho E / pi cd/m^2. Colours are
// linear Rec. 709.
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "licht/core/math.h"
#include "licht/image/image.h"
#include "licht/shared/bvh_numerics.h"
#include "licht/shared/material.h"
#include "licht/shared/slots.h"

namespace licht {

inline constexpr std::uint32_t kNone = 0xffffffffU;

/// Coordinates beyond this (metres) are no geometry: squared distances of such points leave the range of a
/// float.
inline constexpr float kMaxCoordinate = kBvhLargestCoordinate;

/// True for a finite point within kMaxCoordinate on every axis.
bool isPlace(const vec3& point);

/// Texels as stored, RGBA; the colour space is a matter of the slot that reads them.
struct Texture {
    std::string name;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t bits = 8;           ///< 8 or 16 per channel
    std::vector<std::uint8_t> bytes;  ///< RGBA, 16 bit little-endian
};

enum class Wrap : std::uint32_t { repeat, clamp, mirror };

/// How a material reads a texture.
struct TextureSlot {
    std::uint32_t texture = kNone;
    std::uint32_t uv_set = 0;
    Wrap wrap_u = Wrap::repeat;
    Wrap wrap_v = Wrap::repeat;
    bool linear = true;       ///< bilinear, else nearest
    vec3 u_from_uv{1, 0, 0};  ///< u' = dot(u_from_uv, (u, v, 1)); KHR_texture_transform
    vec3 v_from_uv{0, 1, 0};

    [[nodiscard]] bool present() const { return texture != kNone; }
};

enum class AlphaMode : std::uint32_t { opaque, mask, blend };

/// glTF 2.0 metallic-roughness with the material extensions of scene/gltf_extensions.h.
struct Material {
    std::string name;
    vec4 base_color{1.0F};
    float metallic = 1.0F;
    float roughness = 1.0F;
    vec3 emission{0.0F};  ///< emissiveFactor * emissiveStrength, cd/m^2
    float normal_scale = 1.0F;
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5F;
    bool double_sided = false;
    bool unlit = false;
    float ior = 1.5F;  ///< 0: the specular-glossiness rule of KHR_materials_ior, Fresnel = 1
    float specular = 1.0F;
    vec3 specular_color{1.0F};
    IridescenceRecord iridescence{0.0F, 1.3F, 100.0F, 400.0F};
    ClearcoatRecord clearcoat{0.0F, 0.0F, 1.0F, 0.0F};
    std::array<TextureSlot, kSlotCount> slots{};  ///< by kSlot...

    /// The same light from every point and in every direction, and whole.
    [[nodiscard]] bool emitsEvenly() const {
        return !slots[kSlotEmissive].present() && clearcoat.factor == 0.0F && alpha_mode == AlphaMode::opaque;
    }
    /// The normal map along whose coordinates tangents are derived; null where none bends a normal.
    [[nodiscard]] const TextureSlot* normalMap() const {
        const TextureSlot& coat = slots[kSlotClearcoatNormal];
        if (slots[kSlotNormal].present() && normal_scale != 0.0F) return &slots[kSlotNormal];
        return coat.present() && clearcoat.factor > 0.0F && clearcoat.normal_scale != 0.0F ? &coat : nullptr;
    }
};

/// Indexed triangles with one material. Every attribute array is empty or as long as positions.
struct Mesh {
    std::string name;
    std::vector<vec3> positions;
    std::vector<vec3> normals;   ///< unit, or zero where a vertex has none; empty: flat, from the faces
    std::vector<vec4> tangents;  ///< w = handedness; empty: derived where a normal map wants them
    std::vector<vec4> colors;    ///< COLOR_0, linear, alpha in w
    std::vector<std::vector<vec2>> uv_sets;  ///< TEXCOORD_0..n
    std::vector<uvec3> triangles;
    std::uint32_t material = 0;

    /// Of a vertex; 0 where the mesh has no such set.
    [[nodiscard]] vec2 uv(std::size_t set, std::size_t vertex) const {
        return set < uv_sets.size() && !uv_sets[set].empty() ? uv_sets[set][vertex] : vec2(0.0F);
    }
};

/// A mesh placed in the world.
struct Instance {
    std::string name;
    std::uint32_t mesh = 0;
    mat4 world_from_object{1.0F};
};

/// Looks along -Z of its own frame, +Y up, as in glTF.
struct Camera {
    enum class Kind : std::uint32_t { perspective, orthographic };
    std::string name;
    Kind kind = Kind::perspective;
    mat4 world_from_view{1.0F};
    float y_fov = 0.8F;     ///< perspective: whole vertical angle, radians
    float y_extent = 1.0F;  ///< orthographic: half height (glTF's ymag)
    float aspect = 0.0F;    ///< width / height; 0: the picture's
    float z_near = 0.01F;   ///< metres along its axis; nothing nearer is seen by the camera
    float z_far = 0.0F;     ///< the same; nothing farther is seen; 0: there is no far plane
    std::string node{};     ///< name of what carries it, by which several of one name are told apart
};

/// KHR_lights_punctual. Directional: color * intensity is illuminance in lux; point and spot: luminous
/// intensity in candela.
struct PunctualLight {
    enum class Kind : std::uint32_t { point, spot, directional };
    std::string name;
    Kind kind = Kind::point;
    vec3 intensity{1.0F};      ///< colour * intensity
    vec3 position{0.0F};       ///< world
    vec3 direction{0, 0, -1};  ///< world, unit, the way the light travels (spot, directional)
    float inner_cone = 0.0F;   ///< radians
    float outer_cone = 0.7853982F;
    float range = 0.0F;             ///< metres; 0: unlimited
    float angular_diameter = 0.0F;  ///< radians that a directional light fills, at most pi; 0: sharp shadows
};

/// Of directional lights, radians. Smaller ones are points: unit directions in fp32, in steps of 6e-8, hardly
/// resolve them.
constexpr float kSmallestAngularDiameter = 1e-5F;

/// Whether it is a disc in the sky, which surfaces reflect and cameras see.
bool fillsAngle(const PunctualLight& light);

/// Radiance from infinitely far: a lat-long map in cd/m^2. Row 0 is the zenith (+Y), the centre of the map
/// looks along -Z and columns grow to the right as seen from inside (shaders/pure/latlong.glsl). A constant
/// sky is a 1x1 map.
struct Environment {
    std::string name;
    Image radiance;
    float turn = 0.0F;  ///< about +Y, counter-clockwise from above, in whole turns: [0,1)
};

/// Why something was left out of a scene or changed while loading. One line each.
struct SceneNote {
    enum class Kind { warning, skipped };
    Kind kind = Kind::warning;
    std::string text;
};

struct Scene {
    std::string name;
    std::vector<Texture> textures;
    std::vector<Material> materials;  ///< never empty when meshes are there
    std::vector<Mesh> meshes;
    std::vector<Instance> instances;
    std::vector<Camera> cameras;
    std::vector<PunctualLight> lights;
    std::optional<Environment> environment;
    std::vector<SceneNote> notes;
    std::vector<std::filesystem::path> files;  ///< all that it names, itself included; empty: built in
    glm::dvec3 origin{0.0};                    ///< what of the file's world is the origin here, metres
    double default_exposure = 0.0;             ///< EV the scene's author suggests
};

/// World bounds of all instances; empty when there is no geometry.
Bounds sceneBounds(const Scene& scene);

/// A camera that sees all of the bounds from the front and a little above, for scenes that bring none.
/// Deterministic.
Camera framingCamera(const Bounds& bounds, float aspect);

/// What emits less (cd/m^2, mean of RGB) everywhere lights nothing that a neutral sky of 1 would not drown.
inline constexpr float kDimmestEmission = 1e-4F;

/// Largest radiance that a surface sends (cd/m^2, mean of RGB); a texture counts by its brightest texel.
float brightestEmission(const Scene& scene);

/// True where nothing in the scene gives light to what wants it: no surface emits (a black texture emits
/// nothing), no punctual light, no environment, and not everything is unlit.
bool isDark(const Scene& scene);

/// A constant sky of that radiance (cd/m^2).
Environment constantEnvironment(const vec3& radiance);

/// Checks what every consumer relies on (indices in range, array lengths, finite transforms). Throws
/// InputError naming the object.
void validateScene(const Scene& scene);

}  // namespace licht
