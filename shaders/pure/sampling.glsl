// Warps of uniform numbers to the shapes that light transport samples. Each pdf names its measure.
#ifndef LICHT_PURE_SAMPLING_GLSL
#define LICHT_PURE_SAMPLING_GLSL

#include "pure/random.glsl"

const float kPi = 3.14159265358979323846;
const float kInvPi = 0.31830988618379067154;

// (cos, sin) of 2 pi u for u in [0,1). The built-in functions may be off by 2^-11, which would leave directions that are not unit length;
// here the angle is reduced to [-pi/4, pi/4] and the Taylor polynomials end below half an ulp.
vec2 unitCircle(float u) {
    float quarter = floor(4.0 * u + 0.5);
    float x = (4.0 * u - quarter) * (0.5 * kPi);
    float x2 = x * x;
    float s = x * (1.0 + x2 * (-1.0 / 6.0 + x2 * (1.0 / 120.0 + x2 * (-1.0 / 5040.0 + x2 * (1.0 / 362880.0)))));
    float c = 1.0 + x2 * (-0.5 + x2 * (1.0 / 24.0 + x2 * (-1.0 / 720.0 + x2 * (1.0 / 40320.0))));
    uint q = uint(quarter) & 3u;
    vec2 r = (q & 1u) == 0u ? vec2(c, s) : vec2(-s, c);
    return (q & 2u) == 0u ? r : -r;
}

// Uniform on the unit disc, by inversion of radius and angle.
vec2 sampleDisc(vec2 u) { return sqrt(u.x) * unitCircle(u.y); }

// Around +Z. Malley's method: lift the disc.
vec3 sampleCosineHemisphere(vec2 u) {
    vec2 d = sampleDisc(u);
    return vec3(d, sqrt(max(1.0 - u.x, 0.0)));
}

// Solid angle.
float pdfCosineHemisphere(float cos_theta) { return max(cos_theta, 0.0) * kInvPi; }

vec3 sampleUniformSphere(vec2 u) {
    float z = 1.0 - 2.0 * u.x;
    return vec3(2.0 * sqrt(max(u.x * (1.0 - u.x), 0.0)) * unitCircle(u.y), z);
}

// Uniform by solid angle around +Z, density 1 / (2 pi).
vec3 sampleUniformHemisphere(vec2 u) { return vec3(sqrt(max(u.x * (2.0 - u.x), 0.0)) * unitCircle(u.y), 1.0 - u.x); }

// Uniform in the unit ball.
vec3 sampleBall(vec3 u) { return pow(u.z, 1.0 / 3.0) * sampleUniformSphere(u.xy); }

// The same by rejection (von Neumann 1951, Various Techniques Used in Connection with Random Digits): points of the square or cube around the shape until
// one is inside. It takes 4 / pi and 6 / pi tries on average; what the last one refuses, 2e-11 and 5e-11 of all, gets the closed form. `bits` seeds the
// tries, the first of which is these numbers themselves. Evenly spread numbers are torn apart by it, so that the renderer uses the closed forms.
const uint kDiscTries = 16u;
const uint kBallTries = 32u;

vec2 sampleDiscByRejection(uvec4 bits, out uint tries) {
    for (tries = 1u; tries <= kDiscTries; ++tries) {
        vec2 p = 2.0 * uniformFromBits(bits).xy - 1.0;
        if (dot(p, p) < 1.0) return p;
        bits = hash4(bits);
    }
    tries = kDiscTries;
    return sampleDisc(uniformFromBits(bits).xy);
}

vec3 sampleBallByRejection(uvec4 bits, out uint tries) {
    for (tries = 1u; tries <= kBallTries; ++tries) {
        vec3 p = 2.0 * uniformFromBits(bits).xyz - 1.0;
        if (dot(p, p) < 1.0) return p;
        bits = hash4(bits);
    }
    tries = kBallTries;
    return sampleBall(uniformFromBits(bits).xyz);
}

// Uniform by solid angle: the ball's point pushed out to the sphere, and up. A length that leaves nothing of a direction (one point in 2^60) points up.
vec3 sampleHemisphereByRejection(uvec4 bits, out uint tries) {
    vec3 p = sampleBallByRejection(bits, tries);
    float length2 = dot(p, p);
    return length2 > 0.0 ? vec3(p.xy, abs(p.z)) * inversesqrt(length2) : vec3(0.0, 0.0, 1.0);
}

vec3 sampleCosineHemisphereByRejection(uvec4 bits, out uint tries) {
    vec2 d = sampleDiscByRejection(bits, tries);
    return vec3(d, sqrt(1.0 - dot(d, d)));
}

// Barycentrics (b1, b2), uniform by area. Heitz 2019, A Low-Distortion Map Between Triangle and Square.
vec2 sampleTriangle(vec2 u) {
    if (u.y > u.x) {
        float b1 = 0.5 * u.x;
        return vec2(b1, u.y - b1);
    }
    float b2 = 0.5 * u.y;
    return vec2(u.x - b2, b2);
}

// MIS weights for one sample of each of two techniques. Veach 1997, Robust Monte Carlo Methods for Light Transport Simulation.
// Written by the ratio, so that large densities do not overflow.
float balanceWeight(float pdf, float other_pdf) { return 1.0 / (1.0 + other_pdf / pdf); }

// With exponent two.
float powerWeight(float pdf, float other_pdf) {
    float ratio = other_pdf / pdf;
    return 1.0 / (1.0 + ratio * ratio);
}

#endif
