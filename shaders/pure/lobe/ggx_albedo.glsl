// How much of the light of a direction rough microfacets reflect in all, when each reflects once: the integrals that layers and light between microfacets
// are balanced by. Fitted, for lanes in lockstep fetch dearly and calculate cheaply.
// Karis 2013, Real Shading in Unreal Engine 4, has the two integrals; Kulla and Conty 2017, Revisiting Physically Based Shading at Imageworks, their use.
#ifndef LICHT_PURE_LOBE_GGX_ALBEDO_GLSL
#define LICHT_PURE_LOBE_GGX_ALBEDO_GLSL

#include "pure/lobe/fresnel.glsl"

// Of microfacets whose reflectance is Schlick's f0 + (f90 - f0) (1 - cos)^5, the albedo is linear in f0 and f90.
struct GgxAlbedo {
    float white;    // f0 = f90 = 1
    float grazing;  // f0 = 0, f90 = 1
    float cosine;   // of the direction; a mean: of what it is the mean of
};

float albedoOf(GgxAlbedo a, float f0, float f90) { return f0 * (a.white - a.grazing) + f90 * a.grazing; }
vec3 albedoOf(GgxAlbedo a, vec3 f0, float f90) { return f0 * (a.white - a.grazing) + f90 * a.grazing; }

// What white microfacets lose of light at an angle. masking: Smith's G1, the variable in which shallow angles look alike for all widths. Not more than
// 0.001 above and 0.004 below what is lost.
float lossOfGgx(float masking, float alpha) {
    float g = masking;
    vec3 by_alpha = vec3((1.0 - g) * (0.1176 + g * (0.0425 + g * 0.3721)), 0.1458 + g * (-0.4052 + g * (0.271 + g * -0.0166)),
                         0.6399 + g * (2.3467 + g * (-3.822 + g * 1.0863)));
    vec3 below = vec3(1.0 + g * (0.6423 + g * -1.4525), -1.1691 + g * (2.5522 + g * -1.529), 0.5302 + g * (0.2254 + g * -0.4432));
    vec3 powers = vec3(1.0, alpha, alpha * alpha);
    return clamp(g * dot(by_alpha, powers) / dot(below, powers), 0.0, 1.0);
}

// The cosine at which one (1 - cos)^5 stands for the mean over the half vectors. stretched: the direction's cosine once the microfacets are stretched to
// those of width one.
float meanHalfCosine(float cosine, float stretched, float alpha) {
    float c = stretched;
    float r = sqrt(alpha);
    vec3 by_r = vec3(6.6718 + c * (-13.6549 + c * 6.9616), 28.6214 + c * (-20.86 + c * -7.2064), -15.306 + c * (-14.6212 + c * 26.9404));
    vec3 below = vec3(1.0 + c * (-1.9422 + c * 0.9613), 14.4534 + c * (-10.0765 + c * -4.3603), 28.8126 + c * (-34.4614 + c * 10.8021));
    vec3 powers = vec3(1.0, r, alpha);
    return clamp(cosine + alpha * dot(by_r, powers) / dot(below, powers), 0.0, 1.0);
}

// cosine: of the direction, above the surface. Not more than 0.0015 below and 0.008 above the integrals, so that what is balanced by them gains nothing that
// would show (tests/shader/energy_test.cpp).
GgxAlbedo albedoGgx(float cosine, float alpha) {
    float c = clamp(cosine, 0.0, 1.0);
    float stretched = c * inversesqrt(max(c * c + alpha * alpha * (1.0 - c * c), 1e-30));
    float white = 1.0 - lossOfGgx(2.0 * stretched / (1.0 + stretched), alpha);  // G1 of that cosine
    return GgxAlbedo(white, white * fresnelSchlick(vec3(0.0), 1.0, meanHalfCosine(c, stretched, alpha)).x, c);
}

// The means of both over the hemisphere, by cosine. What an angle loses over the mean loss is not more than 0.002 above and 0.006 below the quotient.
GgxAlbedo meanAlbedoGgx(float alpha) {
    const float kMeanCosine = 2.0 / 3.0;
    float r = sqrt(alpha);
    return GgxAlbedo(1.0 - alpha * alpha * (5.0204 + r * (-9.6297 + r * (9.7236 + r * (-6.9962 + r * 2.4769)))),
                     0.0453 + r * (0.0569 + r * (-0.4641 + r * (0.6018 + r * -0.2343))), kMeanCosine);
}

#endif
