#pragma once
#include <vector>

#include "licht/scene/effects.h"
#include "licht/scene/scene.h"
#include "licht/settings/settings.h"
#include "licht/shared/index.h"
#include "licht/shared/light.h"

namespace licht {

/// Everything that next event estimation can pick.
struct LightTable {
    std::vector<LightRecord>
        lights;  ///< triangles (two for a rectangle, all for a round mesh), points and
                 ///< spots; then directional, those that fill an angle last; then the sky
    std::vector<AliasRecord>
        alias;  ///< over the lights or, with a tree, over the tree and each light outside
    std::vector<LightChildRecord> tree;  ///< empty: none
    uint tree_lights = 0;                ///< the first so many lights are picked by the tree
    std::vector<uint> first_light;       ///< per scene instance: light of its primitive 0, or kNoIndex
    uint environment_light = kNoIndex;
    uint first_sun = 0;  ///< directional lights that fill an angle
    uint suns = 0;
};

/// A triangle, rectangle or round mesh that emits.
bool isShape(const LightRecord& light);

/// What is picked beside the lights that scattering cannot find.
struct Pickable {
    bool surfaces_and_suns = true;
    bool sky = true;
};

/// The kinds of light (triangles, punctual, environment; or the tree, directional, environment) share the
/// picks equally, because their powers say nothing of how much of each reaches a given place; within a kind
/// the share is by the choice. A tree takes at least two lights that are somewhere; with fewer the choice is
/// by power.
LightTable buildLightTable(const Scene& scene, const Effects& effects, const Pickable& pickable,
                           LightChoice choice);

}  // namespace licht
