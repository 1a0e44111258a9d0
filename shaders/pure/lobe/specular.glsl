// The specular layer of glTF 2.0's metallic-roughness model with KHR_materials_specular, KHR_materials_ior and KHR_materials_iridescence: a dielectric
// interface over the diffuse layer and a metal, side by side by the share of the metal, both rough by the same GGX distribution.
#ifndef LICHT_PURE_LOBE_SPECULAR_GLSL
#define LICHT_PURE_LOBE_SPECULAR_GLSL

#include "pure/lobe/fresnel.glsl"
#include "pure/lobe/ggx.glsl"
#include "pure/lobe/lobe.glsl"
#include "pure/lobe/thin_film.glsl"
#include "shared/effects.h"

layout(constant_id = kEffectIridescence) const bool kIridescence = true;

struct Specular {
    float alpha;              // GGX width, at least kMinAlpha
    vec3 f0;                  // reflectance at normal incidence, dielectric and metal mixed
    float f90;                // and at grazing incidence
    float dielectric_f0;      // of the dielectric share alone (largest channel): what the layer below does not receive
    float dielectric_f90;
    ThinFilm thin_film;
    vec3 film_dielectric_f0;  // what lies under the thin film: the dielectric share
    vec3 film_metal_f0;       // and the metal
    float metallic;           // share of the metal
};

// Without a thin film.
Specular plainSpecular(float alpha, vec3 f0, float f90, float dielectric_f0, float dielectric_f90) {
    return Specular(alpha, f0, f90, dielectric_f0, dielectric_f90, ThinFilm(0.0, 1.0, 0.0), vec3(0.0), vec3(0.0), 0.0);
}

const Specular kNoSpecular = Specular(1.0, vec3(0.0), 0.0, 0.0, 0.0, ThinFilm(0.0, 1.0, 0.0), vec3(0.0), vec3(0.0), 0.0);

bool hasThinFilm(Specular s) { return kIridescence && s.thin_film.strength > 0.0; }

// cos_h: between wo or wi and the half vector.
vec3 reflectanceSpecular(Specular s, float cos_h) {
    vec3 plain = fresnelSchlick(s.f0, s.f90, cos_h);
    if (!hasThinFilm(s)) return plain;
    ThinFilmResponse response = thinFilmResponse(s.thin_film, cos_h);
    vec3 dielectric = fresnelThinFilm(s.thin_film, response, s.film_dielectric_f0);
    vec3 metal = fresnelThinFilm(s.thin_film, response, s.film_metal_f0);
    return mix(plain, mix(dielectric, metal, s.metallic), s.thin_film.strength);
}

LobeValue evaluateSpecular(Specular s, vec3 wo, vec3 wi) {
    vec3 h = normalize(wo + wi);
    GgxValue ggx = evaluateGgx(s.alpha, wo, wi, h);
    return LobeValue(reflectanceSpecular(s, dot(wo, h)) * ggx.f, ggx.pdf);
}

vec3 sampleSpecular(Specular s, vec3 wo, vec2 u) { return sampleGgx(s.alpha, wo, u); }

// Of a thin film what lies under it counts: the film's own reflectance towards wo says little about other half vectors.
vec3 albedoSpecular(Specular s, float cos_o) { return fresnelSchlick(s.f0, s.f90, cos_o); }

// What a dielectric interface passes, for a pair of directions: on the way in and on the way out, and the division makes the albedo of a Lambertian
// layer below towards wo exactly its own times (1 - F(wo)), so that both together never give more than they get. glTF's own formula, 1 - F(half
// vector), gives up to 1.4 times what it gets near grazing. Reciprocal. Kelemen and Szirmay-Kalos 2001, A Microfacet Based Coupled Specular-Matte BRDF
// Model with Importance Sampling.
float passDielectric(float f0, float f90, float cos_o, float cos_i) {
    float out_passed = 1.0 - fresnelSchlick(vec3(f0), f90, cos_o).x;
    float in_passed = 1.0 - fresnelSchlick(vec3(f0), f90, cos_i).x;
    float mean_passed = 1.0 - meanFresnelSchlick(f0, f90);
    return mean_passed > 0.0 ? out_passed * in_passed / mean_passed : 0.0;
}

// A thin film passes what its strongest channel leaves, of both directions the lesser share: reciprocal, and the albedo of what lies below towards wo is
// at most its own times (1 - R(wo)), as without a film. No mean over the hemisphere is known for it in closed form.
float passSpecular(Specular s, float cos_o, float cos_i) {
    float passed = passDielectric(s.dielectric_f0, s.dielectric_f90, cos_o, cos_i);
    if (!hasThinFilm(s)) return passed;
    vec3 towards_o = fresnelThinFilm(s.thin_film, thinFilmResponse(s.thin_film, cos_o), s.film_dielectric_f0);
    vec3 towards_i = fresnelThinFilm(s.thin_film, thinFilmResponse(s.thin_film, cos_i), s.film_dielectric_f0);
    return mix(passed, 1.0 - largest(max(towards_o, towards_i)), s.thin_film.strength);
}

#endif
