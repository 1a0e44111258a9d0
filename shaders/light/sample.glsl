// What sampling a light gives.
#ifndef LICHT_LIGHT_SAMPLE_GLSL
#define LICHT_LIGHT_SAMPLE_GLSL

#include "ray/visibility.glsl"
#include "shared/index.h"

struct LightSample {
    vec3 direction;   // world; its length times t_max reaches the light
    float t_max;      // for the shadow ray
    vec3 radiance;    // towards the vertex; of delta lights irradiance on a facing surface
    float pdf;        // solid angle, with the probability of the pick; of delta lights the pick alone
    bool delta;       // scattering cannot find it
    bool valid;
    uint target;      // see ShadowRay
    float t_enough;
    uint tries;       // of rejection; 0: it was not asked
};

const LightSample kNoLight = LightSample(vec3(0.0), 0.0, vec3(0.0), 0.0, false, false, kNoIndex, 0.0, 0u);

// Of a light that anything blocks.
LightSample lightSample(vec3 direction, float t_max, vec3 radiance, float pdf, bool delta, bool valid) {
    return LightSample(direction, t_max, radiance, pdf, delta, valid, kNoIndex, infinity(), 0u);
}

#endif
