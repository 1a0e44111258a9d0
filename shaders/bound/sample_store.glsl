// One sample of a pixel, and what is counted beside it.
#ifndef LICHT_BOUND_SAMPLE_STORE_GLSL
#define LICHT_BOUND_SAMPLE_STORE_GLSL
#include "bound/environment.glsl"
#include "bound/visibility.glsl"
#include "shared/bindings.h"
#include "shared/choices.h"
#include "shared/counters.h"

layout(rgba32f, binding = kBindingRadiance) uniform writeonly image2D radiance_image;
layout(std430, binding = kBindingCounters) buffer Counters { CounterRecord counters; };

bool finite(vec3 c) { return all(lessThan(floatBitsToUint(c) & 0x7f800000u, uvec3(0x7f800000u))); }

// A driver's cut is reported with the sample that suffered.
void countCutWalk() {
    if (bvh_walk_cut) atomicAdd(counters.cut_walks, 1u);
    bvh_walk_cut = false;
}

// What rejection took for all directions that this invocation has drawn.
void countEnvironmentTries() {
    if (!kEnvironment || kEnvironmentSampling != kEnvironmentRejection || g_environment_samples == 0u) return;
    atomicAdd(counters.environment_samples, g_environment_samples);
    atomicAdd(counters.environment_tries, g_environment_tries);
}

// A sample that is no number counts as black and is reported, never hidden.
void storeSample(uvec2 pixel, vec3 radiance, bool covered) {
    if (!finite(radiance)) {
        radiance = vec3(0.0);
        atomicAdd(counters.nonfinite_samples, 1u);
    }
    imageStore(radiance_image, ivec2(pixel), vec4(radiance, covered ? 1.0 : 0.0));
}

#endif
