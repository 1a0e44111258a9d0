// Lambertian reflection.
#ifndef LICHT_PURE_LOBE_DIFFUSE_GLSL
#define LICHT_PURE_LOBE_DIFFUSE_GLSL

#include "pure/lobe/lobe.glsl"
#include "pure/sampling.glsl"

struct Diffuse {
    vec3 albedo;
};

// received: share of the light that reaches it and gets out again.
LobeValue evaluateDiffuse(Diffuse d, vec3 wi, float received) { return LobeValue(d.albedo * (received * kInvPi), pdfCosineHemisphere(wi.z)); }

vec3 sampleDiffuse(vec2 u) { return sampleCosineHemisphere(u); }

vec3 albedoDiffuse(Diffuse d) { return d.albedo; }

#endif
