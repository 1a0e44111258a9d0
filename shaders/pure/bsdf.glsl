// glTF 2.0's metallic-roughness material (Appendix B of its specification): a clearcoat over a specular layer over a diffuse layer. The lobes stand in
// pure/lobe/, their order here. Local frame, +Z is the normal; wo and wi both point away from the surface.
#ifndef LICHT_PURE_BSDF_GLSL
#define LICHT_PURE_BSDF_GLSL

#include "pure/lobe/clearcoat.glsl"
#include "pure/lobe/diffuse.glsl"
#include "pure/lobe/lobe.glsl"
#include "pure/lobe/specular.glsl"
#include "shared/effects.h"

layout(constant_id = kEffectGlossy) const bool kGlossy = true;

struct Bsdf {
    Diffuse diffuse;
    Specular specular;
    Clearcoat clearcoat;
};

struct BsdfSample {
    vec3 wi;      // local
    float pdf;    // solid angle
    vec3 weight;  // f cos / pdf
    bool valid;   // false: absorbed
};

Bsdf lambertBsdf(vec3 albedo) { return Bsdf(Diffuse(albedo), kNoSpecular, kNoClearcoat); }

Bsdf regularised(Bsdf b) {
    b.specular.alpha = regularisedAlpha(b.specular.alpha);
    b.clearcoat.alpha = regularisedAlpha(b.clearcoat.alpha);
    return b;
}

// About what share of the light all that spreads it evenly sends to a wo.
float albedoOfSpread(Bsdf b, float cos_o) {
    float diffuse = largest(albedoDiffuse(b.diffuse));
    if (kEnergy != kEnergyMultiple) return diffuse;
    return diffuse + largest(albedoMultiple(b.specular, albedoGgx(cos_o, b.specular.alpha), meanAlbedoGgx(b.specular.alpha)));
}

// Share of samples spent on the specular layer: by what it sends towards wo against what is spread evenly.
float shareOfSpecular(Bsdf b, vec3 wo) {
    const float kLeastSpread = 0.02;  // less of it is found by samples of the specular layer, whose tails reach everywhere
    float cos_o = dot(wo, b.specular.normal);
    float specular = largest(albedoSpecular(b.specular, cos_o));
    float spread = albedoOfSpread(b, cos_o);
    if (specular <= 0.0 && !hasThinFilm(b.specular)) return 0.0;
    if (spread <= kLeastSpread * specular && largest(albedoDiffuse(b.diffuse)) <= 0.0) return 1.0;
    return shareOfLobe(specular, spread);
}

// Share of samples spent on the clearcoat.
float shareOfClearcoat(Bsdf b, vec3 wo) {
    float coat = albedoClearcoat(b.clearcoat, wo);
    return shareOfLobe(coat, (1.0 - coat) * min(largest(albedoSpecular(b.specular, dot(wo, b.specular.normal))) + largest(albedoDiffuse(b.diffuse)), 1.0));
}

// For choosing lights: the width of its gloss, and what the specular layer reflects of light along the mirror direction, F G / (4 cos_o),
// over the albedo of the diffuse layer; times D it is pi f cos of the one over that of the other.
vec2 glossTowards(Bsdf b, float cos_o) {
    // Narrower lobes, of some thousandth of a steradian, are seldom met by a sample of a light; scattering finds the lights that they show.
    const float kLeastChosenWidth = 0.02;
    // What has no diffuse layer is taken to have a little, so that lights beside the mirror direction are not forgotten: at most 20 times the one.
    const float kLeastDiffuse = 0.05;
    float alpha = b.specular.alpha;
    float specular = largest(albedoSpecular(b.specular, cos_o));
    if (specular <= 0.0 || alpha < kLeastChosenWidth) return vec2(alpha, 0.0);
    float diffuse = max(albedoOfSpread(b, cos_o), kLeastDiffuse * specular);
    return vec2(alpha, specular * ggxG1(vec3(sqrt(max(1.0 - cos_o * cos_o, 0.0)), 0.0, cos_o), alpha) / (4.0 * cos_o * diffuse));
}

// All that spreads light evenly: the diffuse layer, and what the specular layer's microfacets reflect more than once.
LobeValue evaluateSpread(Bsdf b, vec3 wo, vec3 wi, vec3 h) {
    Specular s = b.specular;
    GgxAlbedo towards_o = albedoGgx(dot(wo, s.normal), s.alpha), towards_i = albedoGgx(dot(wi, s.normal), s.alpha), mean = meanAlbedoGgx(s.alpha);
    LobeValue spread = evaluateDiffuse(b.diffuse, wi, passSpecular(s, dot(wo, h), towards_o, towards_i, mean));
    if (kEnergy == kEnergyMultiple) spread.f += evaluateMultiple(s, towards_o, towards_i, mean);
    return spread;
}

// spread_f: the part of f that spreads light evenly; the rest mirrors it, more or less sharply.
LobeValue evaluateBsdf(Bsdf b, vec3 wo, vec3 wi, out vec3 spread_f) {
    spread_f = vec3(0.0);
    if (!sameSide(wo, wi)) return kNothing;
    if (!kGlossy) {
        LobeValue diffuse = evaluateDiffuse(b.diffuse, wi, 1.0);
        spread_f = diffuse.f;
        return diffuse;
    }
    vec3 h = normalize(wo + wi);
    LobeValue specular = evaluateSpecular(b.specular, wo, wi, h), spread = evaluateSpread(b, wo, wi, h);
    float to_mirror = 1.0, to_diffuse = 1.0;
    if (hasClearcoat(b.clearcoat)) {
        float albedo_o = albedoClearcoat(b.clearcoat, wo), albedo_i = albedoClearcoat(b.clearcoat, wi);
        to_mirror = passClearcoatToMirror(albedo_o, albedo_i);
        to_diffuse = passClearcoatToDiffuse(b.clearcoat, albedo_o, albedo_i, meanAlbedoGgx(b.specular.alpha).grazing * b.specular.dielectric_f90);
    }
    spread_f = to_diffuse * spread.f;
    LobeValue base = over(under(to_mirror, specular), under(to_diffuse, spread), shareOfSpecular(b, wo));
    return hasClearcoat(b.clearcoat) ? over(evaluateClearcoat(b.clearcoat, wo, wi), base, shareOfClearcoat(b, wo)) : base;
}

LobeValue evaluateBsdf(Bsdf b, vec3 wo, vec3 wi) {
    vec3 spread_f;
    return evaluateBsdf(b, wo, wi, spread_f);
}

// By which both parts of the light that a surface sends to wo are divided for filters, so that they vary as slowly as what arrives: what spreads evenly, and
// what mirrors.
struct Demodulation {
    vec3 spread;
    vec3 mirrored;
};

Demodulation demodulationOf(Bsdf b, vec3 wo) {
    if (!kGlossy) return Demodulation(albedoDiffuse(b.diffuse), vec3(0.0));
    float cos_o = dot(wo, b.specular.normal);
    Demodulation d = Demodulation(albedoDiffuse(b.diffuse), albedoSpecular(b.specular, cos_o));
    if (kEnergy == kEnergyMultiple) d.spread += albedoMultiple(b.specular, albedoGgx(cos_o, b.specular.alpha), meanAlbedoGgx(b.specular.alpha));
    if (hasClearcoat(b.clearcoat)) d.mirrored += albedoClearcoat(b.clearcoat, wo);
    return d;
}

// Of one of the lobes; may point below the surface.
vec3 sampleDirection(Bsdf b, vec3 wo, float u_lobe, vec2 u) {
    if (hasClearcoat(b.clearcoat)) {
        float share = shareOfClearcoat(b, wo);
        if (u_lobe < share) return sampleClearcoat(b.clearcoat, wo, u);
        u_lobe = rescaledBelow(u_lobe, share);
    }
    return u_lobe < shareOfSpecular(b, wo) ? sampleSpecular(b.specular, wo, u) : sampleDiffuse(u);
}

BsdfSample sampleBsdf(Bsdf b, vec3 wo, float u_lobe, vec2 u) {
    const BsdfSample kAbsorbed = BsdfSample(vec3(0.0, 0.0, 1.0), 0.0, vec3(0.0), false);
    if (wo.z <= 0.0) return kAbsorbed;
    if (!kGlossy) {
        vec3 wi = sampleDiffuse(u);
        return BsdfSample(wi, pdfCosineHemisphere(wi.z), albedoDiffuse(b.diffuse), wi.z > 0.0);
    }
    vec3 wi = sampleDirection(b, wo, u_lobe, u);
    LobeValue value = evaluateBsdf(b, wo, wi);
    return value.pdf > 0.0 ? BsdfSample(wi, value.pdf, value.f * (wi.z / value.pdf), true) : kAbsorbed;
}

#endif
