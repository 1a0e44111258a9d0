// Identifiers of the effects. The same number is the effect's specialisation constant in every program.
#ifndef LICHT_SHARED_EFFECTS_H
#define LICHT_SHARED_EFFECTS_H
#include "seam.h"

LICHT_SHARED_BEGIN

LICHT_CONSTANT uint kEffectTextures = 0u;    // any texture is read
LICHT_CONSTANT uint kEffectNormalMaps = 1u;  // tangent frames
LICHT_CONSTANT uint kEffectVertexColors = 2u;
LICHT_CONSTANT uint kEffectExtraUvSets = 3u;     // TEXCOORD_1 and up
LICHT_CONSTANT uint kEffectAlpha = 4u;           // MASK or BLEND
LICHT_CONSTANT uint kEffectGlossy = 5u;          // the GGX lobe
LICHT_CONSTANT uint kEffectEmission = 6u;        // surfaces that emit
LICHT_CONSTANT uint kEffectLightTriangles = 7u;  // emissive triangles worth sampling
LICHT_CONSTANT uint kEffectPunctualLights = 8u;
LICHT_CONSTANT uint kEffectEnvironment = 9u;
LICHT_CONSTANT uint kEffectUnlit = 10u;
LICHT_CONSTANT uint kEffectIridescence = 11u;   // thin films
LICHT_CONSTANT uint kEffectInstances = 12u;     // meshes that stand in memory once and in the scene often
LICHT_CONSTANT uint kEffectLightSpheres = 13u;  // round meshes that are sampled as one light each
LICHT_CONSTANT uint kEffectSuns = 14u;          // directional lights that fill an angle
LICHT_CONSTANT uint kEffectClearcoat = 15u;     // clear layers over everything else
LICHT_CONSTANT uint kEffectCount = 16u;

LICHT_SHARED_END
#endif
