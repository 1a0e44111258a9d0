// Whether every ray and every vertex that is queued is taken, once, by the kernel it waits for. A driver may lose some and report nothing; then the picture
// is darker, or black. Each is weighed by its path and its queue: what queues it adds the weight, what takes it subtracts it, and in the end nothing may be
// left. Not by the ballots and counts that queues are made with, which are what may be wrong.
#ifndef LICHT_PATH_BALANCE_GLSL
#define LICHT_PATH_BALANCE_GLSL
#include "path/append.glsl"

uint balance = 0u;  // of this invocation

// Odd, so that no path weighs nothing; each queue has its factor, so that one cannot stand for another.
uint queueWeight(uint which, uint path) { return (2u * path + 1u) * (which == kCountHits ? 1u : (which == kCountRays ? 0x9e3779b1u : 0x85ebca77u)); }

void noteTaken(uint which, uint path) { balance -= queueWeight(which, path); }

// appendTo() of this path.
uint enqueue(uint bounce, uint which, uint path, bool wanted) {
    if (wanted) balance += queueWeight(which, path);
    return appendTo(bounce, which, wanted);
}

// The last of a kernel. Workgroups take turns among the sums, so that their threads do not wait for one word.
void endBalance() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    if (balance != 0u) atomicAdd(queue_counts[group % kQueueBalances], balance);
}

#endif
