#pragma once
#include <vector>

#include "licht/scene/effects.h"
#include "licht/scene/scene.h"
#include "licht/shared/records.h"

namespace licht {

/// Everything that next event estimation can pick.
struct LightTable {
    std::vector<LightRecord> lights;
    std::vector<AliasRecord> alias;  ///< as long as lights
    std::vector<uint> first_light;   ///< per scene instance: light of its primitive 0, or kNoIndex
    uint environment_light = kNoIndex;
};

/// The kinds of light (triangles, punctual, environment) share the picks equally, because their powers say
/// nothing of how much of each reaches a given place; within a kind the share is by power.
/// `sample_surfaces_and_sky` false: only lights that scattering cannot find.
LightTable buildLightTable(const Scene& scene, const Effects& effects, bool sample_surfaces_and_sky);

/// The environment's table over its texels: mean of the bilinear radiance over each texel, times its solid
/// angle.
std::vector<AliasRecord> buildEnvironmentTable(const Environment& environment);

}  // namespace licht
