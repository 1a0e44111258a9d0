// Places in the queues of the wavefront, and the balance of what is queued and what is taken. The including shader has subgroup ballots.
#ifndef LICHT_PATH_APPEND_GLSL
#define LICHT_PATH_APPEND_GLSL
#include "shared/bindings.h"
#include "shared/path.h"

layout(std430, binding = kBindingQueueCounts) buffer QueueCounts { uint queue_counts[]; };

// A place in a queue for every invocation that wants one; called by all together, so that one atomic serves a subgroup. The order of places is left to
// chance; no path depends on it.
uint appendTo(uint bounce, uint which, bool wanted) {
    uvec4 ballot = subgroupBallot(wanted);
    uint total = subgroupBallotBitCount(ballot);
    uint first = 0u;
    if (subgroupElect() && total > 0u) first = atomicAdd(queue_counts[queueCountAt(bounce, which)], total);
    return subgroupBroadcastFirst(first) + subgroupBallotExclusiveBitCount(ballot);
}

#endif
