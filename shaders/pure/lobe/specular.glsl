// The specular layer of glTF 2.0's metallic-roughness model with KHR_materials_specular, KHR_materials_ior and KHR_materials_iridescence: a dielectric
// interface over the diffuse layer and a metal, side by side by the share of the metal, both rough by the same GGX distribution.
#ifndef LICHT_PURE_LOBE_SPECULAR_GLSL
#define LICHT_PURE_LOBE_SPECULAR_GLSL

#include "pure/frame.glsl"
#include "pure/lobe/fresnel.glsl"
#include "pure/lobe/ggx.glsl"
#include "pure/lobe/ggx_albedo.glsl"
#include "pure/lobe/layering.glsl"
#include "pure/lobe/lobe.glsl"
#include "pure/lobe/thin_film.glsl"
#include "shared/choices.h"
#include "shared/constants.h"
#include "shared/effects.h"

layout(constant_id = kEffectIridescence) const bool kIridescence = true;
layout(constant_id = kConstantEnergy) const uint kEnergy = kEnergyMultiple;

struct Specular {
    float alpha;          // GGX width, at least kMinAlpha
    vec3 f0;              // reflectance at normal incidence, dielectric and metal mixed
    float f90;            // and at grazing incidence
    vec3 dielectric_f0;   // of the dielectric share alone
    float dielectric_f90;
    vec3 metal_f0;
    float metallic;       // share of the metal
    vec3 normal;          // in the frame of what lies below
    ThinFilm thin_film;
};

const ThinFilm kNoThinFilm = ThinFilm(0.0, 1.0, 0.0);

// Without a thin film.
Specular plainSpecular(float alpha, vec3 dielectric_f0, float dielectric_f90, vec3 metal_f0, float metallic) {
    return Specular(alpha, mix(dielectric_f0, metal_f0, metallic), mix(dielectric_f90, 1.0, metallic), dielectric_f0, dielectric_f90, metal_f0, metallic,
                    vec3(0.0, 0.0, 1.0), kNoThinFilm);
}

const Specular kNoSpecular = Specular(1.0, vec3(0.0), 0.0, vec3(0.0), 0.0, vec3(0.0), 0.0, vec3(0.0, 0.0, 1.0), kNoThinFilm);

bool hasThinFilm(Specular s) { return kIridescence && s.thin_film.strength > 0.0; }

// Of the film over what is dielectric.
vec3 reflectanceFilm(Specular s, float cos_h) { return fresnelThinFilm(s.thin_film, thinFilmResponse(s.thin_film, cos_h), s.dielectric_f0); }

// cos_h: between wo or wi and the half vector.
vec3 reflectanceSpecular(Specular s, float cos_h) {
    vec3 plain = fresnelSchlick(s.f0, s.f90, cos_h);
    if (!hasThinFilm(s)) return plain;
    ThinFilmResponse response = thinFilmResponse(s.thin_film, cos_h);
    vec3 dielectric = fresnelThinFilm(s.thin_film, response, s.dielectric_f0);
    vec3 metal = fresnelThinFilm(s.thin_film, response, s.metal_f0);
    return mix(plain, mix(dielectric, metal, s.metallic), s.thin_film.strength);
}

// Of light that microfacets reflect once. wo, wi and h in the frame of what lies below, by whose cosine the caller multiplies.
LobeValue evaluateSpecular(Specular s, vec3 wo, vec3 wi, vec3 h) {
    Frame frame = frameFromNormal(s.normal);
    vec3 o = localFromWorld(frame, wo), i = localFromWorld(frame, wi);
    if (!sameSide(o, i)) return kNothing;
    GgxValue ggx = evaluateGgx(s.alpha, o, i, localFromWorld(frame, h), wi.z);
    return LobeValue(reflectanceSpecular(s, dot(wo, h)) * ggx.f, ggx.pdf);
}

// What leaves below its own horizon leaves below everything: it must not pass for a sample of the other lobes.
vec3 sampleSpecular(Specular s, vec3 wo, vec2 u) {
    Frame frame = frameFromNormal(s.normal);
    vec3 i = sampleGgx(s.alpha, localFromWorld(frame, wo), u);
    return i.z > 0.0 ? worldFromLocal(frame, i) : vec3(0.0, 0.0, -1.0);
}

// Of a thin film what lies under it counts: the film's own reflectance towards wo says little about other half vectors.
vec3 albedoSpecular(Specular s, float cos_o) { return fresnelSchlick(s.f0, s.f90, cos_o); }

// Share that leaves in the end, of light that one microfacet sent to another one: it is reflected twice at least, and what does not leave then, a mean share,
// is reflected again. Kulla and Conty 2017, Revisiting Physically Based Shading at Imageworks.
vec3 seriesOfReflections(vec3 f0, float f90, float mean_white) {
    vec3 f = meanFresnelSchlick(f0, f90);
    return f * f * (mean_white / (1.0 - f * (1.0 - mean_white)));
}

// The same of dielectric and metal, each by its share. A thin film's colour has no part in it.
vec3 seriesOfSpecular(Specular s, GgxAlbedo mean) {
    if (kEnergy != kEnergyMultiple) return vec3(0.0);
    return mix(seriesOfReflections(s.dielectric_f0, s.dielectric_f90, mean.white), seriesOfReflections(s.metal_f0, 1.0, mean.white), s.metallic);
}

// Of light that microfacets reflect more than once: what one reflection loses, evenly spread over what one reflection loses the other way. Reciprocal.
vec3 evaluateMultiple(Specular s, GgxAlbedo towards_o, GgxAlbedo towards_i, GgxAlbedo mean) {
    return seriesOfSpecular(s, mean) * ((1.0 - towards_o.white) * (1.0 - towards_i.white) / (1.0 - mean.white) * kInvPi);
}

vec3 albedoMultiple(Specular s, GgxAlbedo towards_o, GgxAlbedo mean) { return seriesOfSpecular(s, mean) * (1.0 - towards_o.white); }

// What the dielectric leaves to what lies below of the light of a direction, or of all directions. once: what it reflects once.
float leftBelow(Specular s, float once, GgxAlbedo a, GgxAlbedo mean) {
    float left = 1.0 - once;
    if (kEnergy == kEnergyMultiple) left -= (1.0 - a.white) * seriesOfReflections(vec3(largest(s.dielectric_f0)), s.dielectric_f90, mean.white).x;
    return max(left, 0.0);
}

float leftByDielectric(Specular s, GgxAlbedo a, GgxAlbedo mean) {
    return leftBelow(s, albedoOf(a, largest(s.dielectric_f0), s.dielectric_f90), a, mean);
}

// Mean of a film's reflectances over the microfacets that light of a direction leaves by. They turn too often for a fit: Gauss' four points along the cap of
// visible normals, four around half of it; the other half is its mirror image. Off by 0.008 at most.
vec3 meanReflectanceFilm(Specular s, float cosine) {
    const vec4 kAlong = 0.5 + 0.5 * vec4(-0.8611363116, -0.3399810436, 0.3399810436, 0.8611363116);
    const vec4 kWeights = 0.5 * vec4(0.3478548451, 0.6521451549, 0.6521451549, 0.3478548451);
    vec3 w = vec3(sqrt(1.0 - cosine * cosine), 0.0, cosine);
    float masked = 1.0 + ggxLambda(w, s.alpha);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 16; ++i) {
        vec3 h = sampleGgxVisibleNormal(w, s.alpha, vec2(kAlong[i & 3], (float(i >> 2) + 0.5) / 8.0));
        float cos_h = dot(w, h), out_z = 2.0 * cos_h * h.z - cosine;
        if (out_z <= 0.0) continue;
        float unshadowed = masked / (masked + ggxLambda(vec3(sqrt(max(1.0 - out_z * out_z, 0.0)), 0.0, out_z), s.alpha));
        sum += kWeights[i & 3] * unshadowed * vec4(reflectanceFilm(s, cos_h), 1.0);
    }
    return sum.w > 0.0 ? sum.rgb / sum.w : reflectanceFilm(s, cosine);
}

// A film leaves what its strongest channel does, as KHR_materials_iridescence has it, so that no other colour comes from below.
float leftByFilm(Specular s, GgxAlbedo a, GgxAlbedo mean) { return leftBelow(s, a.white * largest(meanReflectanceFilm(s, a.cosine)), a, mean); }

// Its mean, by Gauss' three points of the squared cosine, which directions by cosine have evenly.
float meanLeftByFilm(Specular s, GgxAlbedo mean) {
    const vec3 kCosines = sqrt(0.5 + vec3(-0.5, 0.0, 0.5) * 0.7745966692);  // sqrt(3/5)
    const vec3 kWeights = vec3(5.0, 8.0, 5.0) / 18.0;
    return dot(kWeights, vec3(leftByFilm(s, albedoGgx(kCosines.x, s.alpha), mean), leftByFilm(s, albedoGgx(kCosines.y, s.alpha), mean),
                              leftByFilm(s, albedoGgx(kCosines.z, s.alpha), mean)));
}

// glTF 2.0, Appendix B: what is not reflected at the half vector, which is nearly all of it even near grazing. Both layers give up to 1.9 times what they get.
float passByHalfVector(Specular s, float cos_h) {
    float passed = 1.0 - fresnelSchlick(vec3(largest(s.dielectric_f0)), s.dielectric_f90, cos_h).x;
    return hasThinFilm(s) ? mix(passed, 1.0 - largest(reflectanceFilm(s, cos_h)), s.thin_film.strength) : passed;
}

// What the diffuse layer is to get of the light of a direction: all that is not reflected.
float leftBySpecular(Specular s, GgxAlbedo a, GgxAlbedo mean) {
    float left = leftByDielectric(s, a, mean);
    return hasThinFilm(s) ? mix(left, leftByFilm(s, a, mean), s.thin_film.strength) : left;
}

float meanLeftBySpecular(Specular s, GgxAlbedo mean) {
    float left = leftByDielectric(s, mean, mean);
    return hasThinFilm(s) ? mix(left, meanLeftByFilm(s, mean), s.thin_film.strength) : left;
}

// What reaches the diffuse layer and gets out again.
float passSpecular(Specular s, float cos_h, GgxAlbedo towards_o, GgxAlbedo towards_i, GgxAlbedo mean) {
    if (kLayering == kLayeringGltf) return passByHalfVector(s, cos_h);
    float left_o = leftBySpecular(s, towards_o, mean);
    if (kLayering == kLayeringView) return left_o;
    return passedBothWays(left_o, leftBySpecular(s, towards_i, mean), meanLeftBySpecular(s, mean));
}

#endif
