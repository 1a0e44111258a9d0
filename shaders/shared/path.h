// What the kernels of the wavefront hand to each other: paths, and the rays that they wait for.
#ifndef LICHT_SHARED_PATH_H
#define LICHT_SHARED_PATH_H
#include "seam.h"

LICHT_SHARED_BEGIN

struct WavefrontPush {
    uint sample_index;
    uint first_row;  // of this slice
    uint row_count;
    uint bounce;
};

// Records are whole texels, because they are read as such; path/state.glsl packs and unpacks them.
// Of a path:
LICHT_CONSTANT uint kPathHit = 0u;                     // the next vertex
LICHT_CONSTANT uint kPathWay = kPathHit + 1u;          // wo; scatter_pdf
LICHT_CONSTANT uint kPathThroughput = kPathWay + 1u;   // throughput; bounce
LICHT_CONSTANT uint kPathFrom = kPathThroughput + 1u;  // position of the vertex before; pixel x | y << 16
LICHT_CONSTANT uint kPathRadiance = kPathFrom + 1u;    // found so far; normal of the vertex before
LICHT_CONSTANT uint kPathGloss = kPathRadiance + 1u;   // of the vertex before: wo, gloss; then the medium and a word that is free
LICHT_CONSTANT uint kPathTexels = kPathGloss + 1u;
// Of a ray along which a path goes on:
LICHT_CONSTANT uint kRayOrigin = 0u;                  // origin; path
LICHT_CONSTANT uint kRayDirection = kRayOrigin + 1u;  // direction
LICHT_CONSTANT uint kRayTexels = kRayDirection + 1u;
// Of a ray to a light:
LICHT_CONSTANT uint kShadowOrigin = 0u;                     // origin; t_max
LICHT_CONSTANT uint kShadowDirection = kShadowOrigin + 1u;  // direction; path
LICHT_CONSTANT uint kShadowLight = kShadowDirection + 1u;   // what it brings; target
LICHT_CONSTANT uint kShadowEnough = kShadowLight + 1u;      // t_enough, where lights are spheres
LICHT_CONSTANT uint kShadowTexels = kShadowEnough + 1u;

// Queues of a bounce: paths to extend, rays to trace, shadow rays to trace.
LICHT_CONSTANT uint kCountHits = 0u;
LICHT_CONSTANT uint kCountRays = 1u;
LICHT_CONSTANT uint kCountShadows = 2u;
LICHT_CONSTANT uint kQueues = 3u;
LICHT_CONSTANT uint kQueueGroup = 64u;  // threads of a workgroup
// The counts: first the balance of what was queued and taken, as sums of which each thread of a workgroup collects one (path/balance.glsl); then how many
// wait in each queue, bounce by bounce.
LICHT_CONSTANT uint kQueueBalances = kQueueGroup;
LICHT_FUNCTION uint queueCountAt(uint bounce, uint which) { return kQueueBalances + kQueues * bounce + which; }
// Passes a bounce; a recording holds gpu::Commands::kMaxPasses.
LICHT_CONSTANT uint kMostQueueBounces = 40u;

LICHT_SHARED_END
#endif
