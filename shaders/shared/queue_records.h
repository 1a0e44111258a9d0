// What the kernels of a path hand to each other through queues.
#ifndef LICHT_SHARED_QUEUE_RECORDS_H
#define LICHT_SHARED_QUEUE_RECORDS_H
#include "seam.h"

LICHT_SHARED_BEGIN

struct QueuePush {
    uint sample_index;
    uint first_row;  // of this slice
    uint row_count;
    uint bounce;
};

// Records of whole texels, because they are read as such.
// Of a path: hit; wo and scatter_pdf; throughput and bounce | rays before << 16; from and pixel x | y << 16; radiance and normal there; wo and gloss there.
LICHT_CONSTANT uint kPathTexels = 6u;
LICHT_CONSTANT uint kRayTexels = 2u;          // origin and path; direction
LICHT_CONSTANT uint kShadowTexels = 3u;       // origin and t_max; direction and path; what the light adds, and rays before | (target + 1) << kShadowTargetShift
LICHT_CONSTANT uint kShadowTargetShift = 8u;  // with a target, t_max is 1 and its place holds t_enough

// Four counts a bounce: paths to extend, rays to trace, shadow rays to trace.
LICHT_CONSTANT uint kQueueCounts = 4u;
LICHT_CONSTANT uint kCountHits = 0u;
LICHT_CONSTANT uint kCountRays = 1u;
LICHT_CONSTANT uint kCountShadows = 2u;
LICHT_CONSTANT uint kQueueGroup = 64u;  // threads of a workgroup
// Passes a bounce; a recording holds gpu::Commands::kMaxPasses.
LICHT_CONSTANT uint kMostQueueBounces = 40u;

LICHT_SHARED_END
#endif
