// The wavefront: the same estimator as path.comp, cut where rays are traced, with queues between its kernels, so that only what is alive is worked on
// (Laine, Karras, Aila 2013, Megakernels Considered Harmful: Wavefront Path Tracing on GPUs).
#ifndef LICHT_PATH_WAVEFRONT_GLSL
#define LICHT_PATH_WAVEFRONT_GLSL
#include "camera/gbuffer.glsl"
#include "path/balance.glsl"
#include "path/state.glsl"
#include "path/watch.glsl"
#include "shared/bindings.h"
#include "shared/path.h"

layout(push_constant) uniform Push { WavefrontPush push; };
layout(std430, binding = kBindingQueueHits) writeonly buffer QueueHits { uint queue_hits[]; };  // paths
layout(binding = kBindingQueueHitTexels) uniform usamplerBuffer queue_hit_texels;

// What traceList() returns.
void countTruncated(uint traversals) {
    if (traversals > 0u) atomicAdd(counters.truncated_traversals, traversals);
}

uint queueCount(uint bounce, uint which) { return queue_counts[queueCountAt(bounce, which)]; }

// Paths are numbered by the tiles of 8 by 8 pixels that started them.
uint pathOfThread() { return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * kQueueGroup + gl_LocalInvocationIndex; }

uvec2 pixelOfThread() { return uvec2(gl_GlobalInvocationID.x, push.first_row + gl_GlobalInvocationID.y); }

bool insideSlice(uvec2 pixel) { return pixel.x < frame.view.size.x && pixel.y < min(push.first_row + push.row_count, frame.view.size.y); }

#endif
