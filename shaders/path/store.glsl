// One sample of a pixel, and what is counted beside it.
#ifndef LICHT_PATH_STORE_GLSL
#define LICHT_PATH_STORE_GLSL
#include "path/address.glsl"
#include "path/path.glsl"
#include "pure/finite.glsl"
#include "shared/bindings.h"
#include "shared/choices.h"
#include "shared/counters.h"

layout(rgba32f, binding = kBindingRadiance) uniform writeonly image2D radiance_image;
layout(std430, binding = kBindingCounters) buffer Counters { CounterRecord counters; };

// Beside the rays, which are counted where they are traced.
void storeCounts(PathCounts counts) {
    if (counts.truncated_traversals > 0u) atomicAdd(counters.truncated_traversals, counts.truncated_traversals);
    if (counts.environment_samples == 0u) return;
    atomicAdd(counters.environment_samples, counts.environment_samples);
    atomicAdd(counters.environment_tries, counts.environment_tries);
}

// What a filter keeps for longer than a frame must have a square.
const float kLargestFiltered = 1e18;

// A sample that is no number counts as black and is reported, never hidden. Whether it is one.
bool storeSample(uvec2 pixel, vec3 radiance, bool covered) {
    bool finite = allFinite(radiance) && (!kSignals || largest(radiance) < kLargestFiltered);
    if (!finite) {
        radiance = vec3(0.0);
        atomicAdd(counters.nonfinite_samples, 1u);
    }
    imageStore(radiance_image, ivec2(pixel), vec4(radiance, covered ? 1.0 : 0.0));
    return finite;
}

#endif
