#pragma once
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "licht/shared/light.h"

namespace licht {

/// Where a light is, whither it shines and how brightly, as far as the tree cares.
struct LightBound {
    glm::dvec3 low;  ///< world box
    glm::dvec3 high;
    glm::dvec3 axis;              ///< unit: the middle of its normals
    double normals_angle = 0.0;   ///< radians: how far normals stray from the axis; pi: everywhere
    double emission_angle = 0.0;  ///< radians: how far light leaves from a normal
    double intensity = 0.0;       ///< cd towards the axis if all normals were it; greater than 0
    bool two_sided = false;       ///< shines along -axis too
};

/// A tree over lights: one is picked by walking down, at each node by what its children send about. Conty
/// Estevez and Kulla 2018, Importance Sampling of Many Lights with Adaptive Tree Splitting.
struct LightTree {
    std::vector<LightChildRecord> children;  ///< of node i: 4i to 4i + 3; node 0 is the root
    std::vector<uint> trails;                ///< per light: bits 2k and 2k + 1 choose the child at level k
};

/// Lights of a scene, counting each triangle that shines: so many can be told apart by a number that floats
/// pick, and trails through the tree fit.
inline constexpr std::size_t kMostLights = std::size_t{1} << 24U;

/// At least two lights, at most kMostLights.
LightTree buildLightTree(std::span<const LightBound> lights);

/// What the choice among lights knows of the place that is to be lit (shaders/light/shading_point.glsl);
/// Lambertian unless said otherwise.
struct ShadingPoint {
    glm::dvec3 position;  ///< world
    glm::dvec3 normal;    ///< world, unit
    glm::dvec3 wo{0.0};  ///< world, unit, where it sends the light to; heeded where there is a specular layer
    double alpha = 1.0;  ///< GGX width of the specular layer
    double specular = 0.0;  ///< F G / (4 cos_o) of the specular layer over the base's albedo
};

/// Probability that a walk from a surface ends at the light of that trail; the shader's formula in double
/// precision.
double lightTreePmf(const LightTree& tree, const ShadingPoint& point, uint trail);

}  // namespace licht
