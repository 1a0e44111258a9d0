// Round meshes that shine. Such a mesh fills part of the cone of directions to the sphere around it. All of the cone is sampled, alike, and a ray that meets
// something else first or passes by the mesh brings nothing. Inside the sphere it is not sampled: more than half of all directions may end at it, and
// scattering finds them.
#ifndef LICHT_LIGHT_SPHERE_GLSL
#define LICHT_LIGHT_SPHERE_GLSL

#include "light/sample.glsl"
#include "pure/spherical.glsl"
#include "shared/light_views.h"

// The square of the sine of the cone's half angle; 1 or more: inside. to_centre2: squared distance of the centre.
float sine2OfSphere(SphereLight light, float to_centre2) { return light.radius * light.radius / to_centre2; }

float pdfOnSphere(float sine2) { return sine2 < 1.0 ? 1.0 / solidAngleCone(sine2) : 0.0; }

// Of every direction to it, by solid angle. pmf: of the light's being picked.
float pdfOfSphere(LightRecord r, float pmf, vec3 from) {
    SphereLight light = unpackSphere(r);
    vec3 centre = light.centre - from;
    return pmf * pdfOnSphere(sine2OfSphere(light, dot(centre, centre)));
}

// The mesh is closed and faces outwards (emitter_shapes.cpp), so what a ray meets first of it is a front.
vec3 radianceOfSphere(LightRecord r) { return unpackSphere(r).emission; }

LightSample sampleSphere(LightRecord r, float pmf, Vertex from, vec2 u) {
    SphereLight light = unpackSphere(r);
    vec3 centre = light.centre - from.position;
    float d2 = dot(centre, centre);
    float sine2 = sine2OfSphere(light, d2);
    if (!(sine2 < 1.0)) return kNoLight;
    float inverse = inversesqrt(d2), distance = d2 * inverse;
    Frame to_centre = frameFromNormal(centre * inverse);
    vec3 w = sampleCone(sine2, u);
    // The ray goes through the middle of the chord, seen from the centre, so that small and far spheres are not missed by rounding. The mesh is within a
    // radius of that.
    vec3 middle = centre + worldFromLocal(to_centre, distance * vec3(w.z * w.xy, -dot(w.xy, w.xy)));
    float along = distance * w.z;
    float end = along + light.radius;
    vec3 direction = middle + (from.position - offsetOrigin(from, middle));
    float pdf = pmf * pdfOnSphere(sine2);
    bool valid = along > 0.0 && pdf > 0.0 && !isinf(pdf);
    return LightSample(direction * (end / along), 1.0, radianceOfSphere(r), pdf, false, valid, r.instance, (along - light.radius) / end, 0u);
}

#endif
