// Directions of a latitude-longitude map. u grows to the right as seen from inside, u = 1/2 looks along -Z, v = 0 is +Y.
#ifndef LICHT_PURE_LATLONG_GLSL
#define LICHT_PURE_LATLONG_GLSL

#include "pure/sampling.glsl"

// (u, v) in [0,1]^2 of a unit direction.
vec2 latlongFromDirection(vec3 d) {
    // acos(y) loses half the bits near the poles; atan keeps them.
    float theta = atan(length(d.xz), d.y);
    return vec2(0.5 + atan(d.x, -d.z) * (0.5 * kInvPi), theta * kInvPi);
}

// The direction with cos(theta) = y and sin(theta) = s at longitude u.
vec3 directionFromLatlong(float u, float y, float s) {
    vec2 c = unitCircle(fract(u + 0.5));
    return vec3(s * c.y, y, -s * c.x);
}

vec3 directionFromLatlong(float u, float y) { return directionFromLatlong(u, y, sqrt(max((1.0 - y) * (1.0 + y), 0.0))); }

#endif
