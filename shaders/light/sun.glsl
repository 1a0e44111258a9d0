// Directional lights. One that fills a cone of directions, called a sun, sends E over them: radiance E / (pi sin^2), so that a surface that faces it gets E.
// They are never in the tree: a light's own probability is all.
#ifndef LICHT_LIGHT_SUN_GLSL
#define LICHT_LIGHT_SUN_GLSL

#include "bound/scene.glsl"
#include "light/sample.glsl"
#include "pure/spherical.glsl"
#include "shared/light_views.h"

bool isInSun(LightRecord r, vec3 direction) {
    SunLight sun = unpackSun(r);
    return insideCone(-sun.direction, sun.sine2, direction);
}

vec3 radianceOfSun(LightRecord r) {
    SunLight sun = unpackSun(r);
    return sun.illuminance / (kPi * sun.sine2);
}

// Of each of its directions, by solid angle.
float pdfOfSun(LightRecord r) { return r.pmf / solidAngleCone(unpackSun(r).sine2); }

LightSample sampleSun(LightRecord r, vec2 u) {
    SunLight sun = unpackSun(r);
    if (!kSuns || sun.sine2 <= 0.0) return lightSample(-sun.direction, infinity(), sun.illuminance, r.pmf, true, true);
    vec3 direction = worldFromLocal(frameFromNormal(-sun.direction), sampleCone(sun.sine2, u));
    return lightSample(direction, infinity(), radianceOfSun(r), pdfOfSun(r), false, true);
}

#endif
