// What is counted beside the picture.
#ifndef LICHT_SHARED_COUNTERS_H
#define LICHT_SHARED_COUNTERS_H
#include "seam.h"

LICHT_SHARED_BEGIN

// Counted on the device, summed on the host.
struct CounterRecord {
    uint bounce_rays;
    uint shadow_rays;
    uint nonfinite_samples;
    uint truncated_traversals;  // that the driver ended before they were done
    uint environment_samples;   // directions drawn by rejection, and how many were tried for them
    uint environment_tries;
    uint queue_balance;  // of what was queued and taken (path/balance.glsl); other than 0: something was lost
};

LICHT_SHARED_END
#endif
