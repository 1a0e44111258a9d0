// Points and spots of KHR_lights_punctual: inverse square, an optional range window, and a spot's cone. Scattering cannot find them, so they have no density.
#ifndef LICHT_LIGHT_PUNCTUAL_GLSL
#define LICHT_LIGHT_PUNCTUAL_GLSL

#include "light/sample.glsl"
#include "shared/light_views.h"

// On a surface that faces it, `distance2` away in `direction` (unit).
vec3 irradianceOfSpot(LightRecord r, vec3 direction, float distance2) {
    SpotLight light = unpackSpot(r);
    vec3 irradiance = light.intensity / distance2;
    if (light.range > 0.0) {
        float x = distance2 / (light.range * light.range);
        irradiance *= clamp(1.0 - x * x, 0.0, 1.0);
    }
    if (kindOf(r) == kLightSpot) {
        vec3 aside = light.axis + direction;
        float versine = 0.5 * dot(aside, aside);  // 1 - cos of the angle to the axis, without cancellation
        float cone = clamp(light.offset - light.scale * versine, 0.0, 1.0);
        irradiance *= cone * cone;
    }
    return irradiance;
}

LightSample sampleSpot(LightRecord r, float pmf, Vertex from) {
    vec3 position = unpackSpot(r).position;
    vec3 to_light = position - from.position;
    float distance2 = dot(to_light, to_light);
    if (!(distance2 > 0.0)) return kNoLight;
    vec3 direction = to_light * inversesqrt(distance2);
    vec3 irradiance = irradianceOfSpot(r, direction, distance2);
    if (largest(irradiance) <= 0.0) return kNoLight;
    return lightSample(position - offsetOrigin(from, direction), 1.0, irradiance, pmf, true, true);
}

#endif
