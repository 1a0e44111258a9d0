// A pot plant: leaves are curved sheets whose outline is cut by alpha.
#include <cmath>

#include "samples/scenes/assembly.h"
#include "samples/scenes/gallery.h"
#include "samples/scenes/pattern.h"
#include "samples/scenes/shapes.h"

namespace licht::gallery {
namespace {

/// Stalk at the origin, one unit long towards +Z, faces +Y and droops towards its tip.
Mesh leafMesh(std::uint32_t material) {
    constexpr std::uint32_t kAcross = 4;
    constexpr std::uint32_t kAlong = 8;
    return gridMesh("leaf", material, kAcross, kAlong, [](std::uint32_t column, std::uint32_t row) {
        const float u = static_cast<float>(column) / kAcross;
        const float v = static_cast<float>(row) / kAlong;
        const float x = 0.8F * (u - 0.5F);
        const float z = 1.0F - v;
        const vec3 position{x, 0.55F * x * x - 0.35F * z * z, z};
        return ShapeVertex{position, {-1.1F * x, 1.0F, 0.7F * z}, {u, v}};
    });
}

}  // namespace

void addPlant(Scene& scene, const Materials& m) {
    const vec3 foot{2.95F, 0.0F, -0.5F};
    place(scene,
          latheMesh("pot", m.white_ceramic,
                    smoothProfile({{0.0F, 0.0F},
                                   {0.17F, 0.0F},
                                   {0.19F, 0.02F},
                                   {0.25F, 0.2F},
                                   {0.26F, 0.38F},
                                   {0.25F, 0.40F},
                                   {0.235F, 0.39F},
                                   {0.23F, 0.34F},
                                   {0.0F, 0.335F}},
                                  5),
                    48),
          moved(foot));
    place(scene, coneMesh("earth", m.earth, 0.22F, 0.22F, 0.01F, 40), moved(foot + vec3(0, 0.34F, 0)));

    const std::uint32_t leaf = addMesh(scene, leafMesh(m.leaf));
    constexpr std::uint32_t kLeaves = 22;
    // Leaves follow each other at the golden angle, the older ones lower and further out.
    const float golden = kPi * (3.0F - std::sqrt(5.0F));
    for (std::uint32_t k = 0; k < kLeaves; ++k) {
        const float age = static_cast<float>(k) / static_cast<float>(kLeaves - 1);
        const float yaw = golden * static_cast<float>(k) + 0.4F * hashed(k, 0, 91);
        const float height = glm::mix(1.55F, 0.72F, age) + 0.12F * (hashed(k, 1, 91) - 0.5F);
        const float reach = glm::mix(0.10F, 0.42F, std::sqrt(age));
        const vec3 out{std::sin(yaw), 0.0F, std::cos(yaw)};
        const vec3 tip = foot + reach * out + vec3(0, height, 0);
        placeBar(scene, "stem", m.stem, foot + 0.05F * out + vec3(0, 0.34F, 0), tip, 0.008F);
        const float size = glm::mix(0.34F, 0.46F, hashed(k, 2, 91));
        const float pitch = glm::mix(-0.7F, 0.25F, age) + 0.3F * (hashed(k, 3, 91) - 0.5F);
        place(scene, leaf, glm::scale(glm::rotate(moved(tip, yaw), pitch, vec3(1, 0, 0)), vec3(size)));
    }
}

}  // namespace licht::gallery
