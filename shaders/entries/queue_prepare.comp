#version 460
#extension GL_GOOGLE_include_directive : require
// How many workgroups the next kernels of a bounce need.
#include "shared/path.h"
#include "shared/ray_records.h"
#include "shared/bindings.h"
#include "shared/constants.h"
#include "shared/counters.h"

layout(local_size_x = 1) in;
layout(constant_id = kConstantRaysPerThread) const uint kRaysPerThread = 1u;
layout(push_constant) uniform Push { WavefrontPush push; };
layout(std430, binding = kBindingQueueCounts) readonly buffer QueueCounts { uint queue_counts[]; };
layout(std430, binding = kBindingQueueGroups) writeonly buffer QueueGroups { uvec4 queue_groups[]; };  // of VkDispatchIndirectCommand, one of kCount... each
layout(std430, binding = kBindingCounters) buffer Counters { CounterRecord counters; };

void main() {
    for (uint i = 0u; i < kQueues; ++i) {
        uint share = kQueueGroup * (i == kCountHits ? 1u : kRaysPerThread);
        queue_groups[i] = uvec4((queue_counts[queueCountAt(push.bounce, i)] + share - 1u) / share, 1u, 1u, 0u);
    }
    // Zero until the paths of this bounce are extended.
    counters.bounce_rays += queue_counts[queueCountAt(push.bounce, kCountRays)];
    counters.shadow_rays += queue_counts[queueCountAt(push.bounce, kCountShadows)];
}
