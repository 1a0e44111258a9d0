// Ids of the specialisation constants beside the effects.
#ifndef LICHT_SHARED_CONSTANTS_H
#define LICHT_SHARED_CONSTANTS_H
#include "effects.h"

LICHT_SHARED_BEGIN

// Effects have the ids below, by their own numbers.
LICHT_CONSTANT uint kFirstConstant = 64u;
LICHT_ASSERT(kEffectCount <= kFirstConstant);

// Each is one more than the one before, so that no two are the same.
LICHT_CONSTANT uint kConstantDirect = kFirstConstant;
LICHT_CONSTANT uint kConstantMisBalance = kConstantDirect + 1u;
LICHT_CONSTANT uint kConstantLights = kConstantMisBalance + 1u;
LICHT_CONSTANT uint kConstantEnvironmentSampling = kConstantLights + 1u;
LICHT_CONSTANT uint kConstantSampler = kConstantEnvironmentSampling + 1u;
LICHT_CONSTANT uint kConstantBlueBits = kConstantSampler + 1u;  // log2 of the samples whose error is blue together
LICHT_CONSTANT uint kConstantClamp = kConstantBlueBits + 1u;
LICHT_CONSTANT uint kConstantRegularise = kConstantClamp + 1u;
LICHT_CONSTANT uint kConstantLayering = kConstantRegularise + 1u;
LICHT_CONSTANT uint kConstantEnergy = kConstantLayering + 1u;
LICHT_CONSTANT uint kConstantOrders = kConstantEnergy + 1u;                 // layers of the orders T^i Le: 0 none, else bounces + 1
LICHT_CONSTANT uint kConstantAdaptive = kConstantOrders + 1u;               // pixels are sampled where a mask says so
LICHT_CONSTANT uint kConstantSignals = kConstantAdaptive + 1u;              // what filters work on is kept
LICHT_CONSTANT uint kConstantReprojects = kConstantSignals + 1u;            // what earlier views have told is kept
LICHT_CONSTANT uint kConstantSceneMoves = kConstantReprojects + 1u;         // and what they showed may be elsewhere now
LICHT_CONSTANT uint kConstantSpatial = kConstantSceneMoves + 1u;            // pixels are filtered with their neighbours
LICHT_CONSTANT uint kConstantFirstLevel = kConstantSpatial + 1u;            // of the filter
LICHT_CONSTANT uint kConstantPathsPerThread = kConstantFirstLevel + 1u;     // that a thread follows one after the other
LICHT_CONSTANT uint kConstantRaysPerThread = kConstantPathsPerThread + 1u;  // of a list that a thread traces
LICHT_CONSTANT uint kConstantAnyHit = kConstantRaysPerThread + 1u;          // of a list: the first hit that is found ends a ray
LICHT_CONSTANT uint kConstantBvhInStorage = kConstantAnyHit + 1u;           // the tree is read from storage buffers
LICHT_CONSTANT uint kConstantBvhStackSize = kConstantBvhInStorage + 1u;
LICHT_CONSTANT uint kConstantSceneInStorage = kConstantBvhStackSize + 1u;           // and so are the records
LICHT_CONSTANT uint kConstantTexturePages = kConstantSceneInStorage + 1u;           // pages of texels in use
LICHT_CONSTANT uint kConstantTextureSlotKinds = kConstantTexturePages + 1u;         // bits 1 << kSlot... of the slots that read a texture
LICHT_CONSTANT uint kConstantWideTexels = kConstantTextureSlotKinds + 1u;           // 16 bits per channel
LICHT_CONSTANT uint kConstantBakedInstances = kConstantWideTexels + 1u;             // instances below this number are baked
LICHT_CONSTANT uint kConstantFirstInstancePosition = kConstantBakedInstances + 1u;  // positions from here on are instances
LICHT_CONSTANT uint kConstantFirstInstanceTexel =
    kConstantFirstInstancePosition + 1u;                                        // added to an instance's position it gives the texel with its root and number
LICHT_CONSTANT uint kConstantInstanceSlack = kConstantFirstInstanceTexel + 1u;  // the bits of a float
LICHT_CONSTANT uint kConstantMergedInstances = kConstantInstanceSlack + 1u;     // instances below this number may be drawn many at once

LICHT_SHARED_END
#endif
