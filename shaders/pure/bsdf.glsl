// glTF 2.0 metallic-roughness (Appendix B of its specification) with KHR_materials_specular, KHR_materials_ior and KHR_materials_iridescence:
// a Lambertian base under a GGX coat. The base receives what the coat passes (passedToBase). Local frame, +Z is the normal; wo and wi both
// point away from the surface; only wo.z > 0 and wi.z > 0 reflect.
// Three verbs: evaluate gives f (1/sr, without the cosine), pdf its density (solid angle), sample a direction with its weight f cos / pdf.
#ifndef LICHT_PURE_BSDF_GLSL
#define LICHT_PURE_BSDF_GLSL

#include "pure/iridescence.glsl"
#include "pure/microfacet.glsl"
#include "shared/effects.h"

layout(constant_id = kEffectGlossy) const bool kGlossy = true;
layout(constant_id = kEffectIridescence) const bool kIridescence = true;

struct Bsdf {
    vec3 diffuse;             // albedo of the base: base colour * (1 - metallic)
    float alpha;              // GGX width, at least kMinAlpha
    vec3 f0;                  // reflectance of the coat at normal incidence, dielectric and metal mixed
    float f90;                // and at grazing incidence
    float dielectric_f0;      // of the dielectric share alone (largest channel): what the base does not receive
    float dielectric_f90;
    ThinFilm film;
    vec3 film_dielectric_f0;  // what lies under the film: the dielectric share
    vec3 film_metal_f0;       // and the metal
    float metallic;           // share of the metal
};

struct BsdfSample {
    vec3 wi;      // local
    float pdf;    // solid angle
    vec3 weight;  // f cos / pdf
    bool valid;   // false: absorbed
};

// Without a film.
Bsdf plainBsdf(vec3 diffuse, float alpha, vec3 f0, float f90, float dielectric_f0, float dielectric_f90) {
    return Bsdf(diffuse, alpha, f0, f90, dielectric_f0, dielectric_f90, ThinFilm(0.0, 1.0, 0.0), vec3(0.0), vec3(0.0), 0.0);
}

Bsdf lambertBsdf(vec3 albedo) { return plainBsdf(albedo, 1.0, vec3(0.0), 0.0, 0.0, 0.0); }

// Biased: a narrow lobe behind another scattering makes rare bright paths, a wider one blurs what only they would show. The widths are those of pbrt-v4
// (Pharr, Jakob, Humphreys 2023, Physically Based Rendering, section 14.2.3, path regularization).
Bsdf regularised(Bsdf b) {
    if (b.alpha < 0.3) b.alpha = clamp(2.0 * b.alpha, 0.1, 0.3);
    return b;
}

// Narrower lobes find lights by scattering.
const float kLeastChosenWidth = 0.02;

float largest(vec3 c) { return max(c.x, max(c.y, c.z)); }

bool hasFilm(Bsdf b) { return kIridescence && b.film.strength > 0.0; }

// What a dielectric coat leaves to the base, for a pair of directions: it passes on the way in and on the way out, and the division makes
// the base's albedo towards wo exactly diffuse * (1 - F(wo)), so that coat and base together never give more than they get. glTF's own
// formula, 1 - F(half vector), gives up to 1.4 times what it gets near grazing. Reciprocal. Kelemen and Szirmay-Kalos 2001, A Microfacet
// Based Coupled Specular-Matte BRDF Model with Importance Sampling.
float passedByCoat(Bsdf b, float cos_o, float cos_i) {
    vec3 f0 = vec3(b.dielectric_f0);
    float out_passed = 1.0 - fresnelSchlick(f0, b.dielectric_f90, cos_o).x;
    float in_passed = 1.0 - fresnelSchlick(f0, b.dielectric_f90, cos_i).x;
    // Mean over the hemisphere of 1 - F: the integral of 2 c (1 - c)^5 is 1/21.
    float mean_passed = 1.0 - mix(b.dielectric_f0, b.dielectric_f90, 1.0 / 21.0);
    return mean_passed > 0.0 ? out_passed * in_passed / mean_passed : 0.0;
}

// What coat and film leave to the base. A film passes what its strongest channel leaves, of both directions the lesser share: reciprocal, and the
// base's albedo towards wo is at most diffuse * (1 - R(wo)), as under the plain coat. No mean over the hemisphere is known for it in closed form.
float passedToBase(Bsdf b, float cos_o, float cos_i) {
    float passed = passedByCoat(b, cos_o, cos_i);
    if (!hasFilm(b)) return passed;
    vec3 towards_o = fresnelThinFilm(b.film, filmResponse(b.film, cos_o), b.film_dielectric_f0);
    vec3 towards_i = fresnelThinFilm(b.film, filmResponse(b.film, cos_i), b.film_dielectric_f0);
    return mix(passed, 1.0 - largest(max(towards_o, towards_i)), b.film.strength);
}

// Reflectance of the coat. cos_h: between wo or wi and the half vector.
vec3 coatReflectance(Bsdf b, float cos_h) {
    vec3 plain = fresnelSchlick(b.f0, b.f90, cos_h);
    if (!hasFilm(b)) return plain;
    FilmResponse response = filmResponse(b.film, cos_h);
    vec3 dielectric = fresnelThinFilm(b.film, response, b.film_dielectric_f0);
    vec3 metal = fresnelThinFilm(b.film, response, b.film_metal_f0);
    return mix(plain, mix(dielectric, metal, b.metallic), b.film.strength);
}

// Share of samples spent on the coat: by its reflectance towards wo against the base's.
float coatProbability(Bsdf b, vec3 wo) {
    float coat = largest(fresnelSchlick(b.f0, b.f90, wo.z));
    float base = largest(b.diffuse);
    // What a film reflects towards wo says little about other half vectors, so its base's coat stands for it; but it reflects by itself.
    if (coat <= 0.0 && !hasFilm(b)) return 0.0;
    if (base <= 0.0) return 1.0;
    // Never starve a lobe: the estimate of its share is for wo alone.
    return clamp(coat / (coat + base), 0.1, 0.9);
}

// What the coat reflects of light along the mirror direction, F G / (4 cos_o), over the base's albedo; times D it is pi f cos of the coat over that of the
// base. For choosing lights: of a film its plain part counts, and what has no base is taken to have a little.
float coatOverBase(Bsdf b, float cos_o) {
    const float kLeastBase = 0.05;
    float coat = largest(fresnelSchlick(b.f0, b.f90, cos_o));
    float base = max(largest(b.diffuse), kLeastBase * coat);
    if (coat <= 0.0 || b.alpha < kLeastChosenWidth) return 0.0;
    return coat * ggxG1(vec3(sqrt(max(1.0 - cos_o * cos_o, 0.0)), 0.0, cos_o), b.alpha) / (4.0 * cos_o * base);
}

vec3 bsdfEvaluate(Bsdf b, vec3 wo, vec3 wi) {
    if (wo.z <= 0.0 || wi.z <= 0.0) return vec3(0.0);
    if (!kGlossy) return b.diffuse * kInvPi;
    vec3 h = normalize(wo + wi);
    vec3 coat = coatReflectance(b, dot(wo, h)) * (ggxD(h, b.alpha) * ggxG2(wo, wi, b.alpha) / (4.0 * wo.z * wi.z));
    return b.diffuse * (passedToBase(b, wo.z, wi.z) * kInvPi) + coat;
}

float bsdfPdf(Bsdf b, vec3 wo, vec3 wi) {
    if (wo.z <= 0.0 || wi.z <= 0.0) return 0.0;
    float base = pdfCosineHemisphere(wi.z);
    if (!kGlossy) return base;
    float p_coat = coatProbability(b, wo);
    return mix(base, pdfGgxReflection(wo, normalize(wo + wi), b.alpha), p_coat);
}

BsdfSample bsdfSample(Bsdf b, vec3 wo, float u_lobe, vec2 u) {
    const BsdfSample kAbsorbed = BsdfSample(vec3(0.0, 0.0, 1.0), 0.0, vec3(0.0), false);
    if (wo.z <= 0.0) return kAbsorbed;
    if (!kGlossy) {
        vec3 wi = sampleCosineHemisphere(u);
        return BsdfSample(wi, pdfCosineHemisphere(wi.z), b.diffuse, wi.z > 0.0);
    }
    vec3 wi;
    if (u_lobe < coatProbability(b, wo)) {
        vec3 h = sampleGgxVisibleNormal(wo, b.alpha, u);
        wi = 2.0 * dot(wo, h) * h - wo;
    } else {
        wi = sampleCosineHemisphere(u);
    }
    if (wi.z <= 0.0) return kAbsorbed;
    float pdf = bsdfPdf(b, wo, wi);
    if (!(pdf > 0.0)) return kAbsorbed;
    return BsdfSample(wi, pdf, bsdfEvaluate(b, wo, wi) * (wi.z / pdf), true);
}

#endif
