// KHR_materials_clearcoat: a clear dielectric layer of index 1.5 over everything else, with a roughness and a normal of its own.
#ifndef LICHT_PURE_LOBE_CLEARCOAT_GLSL
#define LICHT_PURE_LOBE_CLEARCOAT_GLSL

#include "pure/frame.glsl"
#include "pure/lobe/fresnel.glsl"
#include "pure/lobe/ggx.glsl"
#include "pure/lobe/ggx_albedo.glsl"
#include "pure/lobe/layering.glsl"
#include "pure/lobe/lobe.glsl"
#include "shared/effects.h"

layout(constant_id = kEffectClearcoat) const bool kClearcoat = true;

const float kClearcoatF0 = 0.04;  // ((1.5 - 1) / (1.5 + 1))^2

struct Clearcoat {
    float factor;  // share of the surface that it covers
    float alpha;   // GGX width, at least kMinAlpha
    vec3 normal;   // in the frame of what lies below
};

const Clearcoat kNoClearcoat = Clearcoat(0.0, 1.0, vec3(0.0, 0.0, 1.0));

bool hasClearcoat(Clearcoat c) { return kClearcoat && c.factor > 0.0; }

// By a cosine with its half vector or, where it is smooth, with its normal. Below its horizon: all.
float reflectanceClearcoat(float factor, float cosine) { return factor * fresnelSchlick(vec3(kClearcoatF0), 1.0, cosine).x; }

// wo and wi in the frame of what lies below, by whose cosine the caller multiplies.
LobeValue evaluateClearcoat(Clearcoat c, vec3 wo, vec3 wi) {
    Frame frame = frameFromNormal(c.normal);
    vec3 o = localFromWorld(frame, wo), i = localFromWorld(frame, wi);
    if (!sameSide(o, i)) return kNothing;
    vec3 h = normalize(o + i);
    GgxValue ggx = evaluateGgx(c.alpha, o, i, h, wi.z);
    return LobeValue(vec3(reflectanceClearcoat(c.factor, dot(o, h)) * ggx.f), ggx.pdf);
}

// What leaves below the coat's own horizon leaves below everything: it must not pass for a sample of the other lobes.
vec3 sampleClearcoat(Clearcoat c, vec3 wo, vec2 u) {
    Frame frame = frameFromNormal(c.normal);
    vec3 i = sampleGgx(c.alpha, localFromWorld(frame, wo), u);
    return i.z > 0.0 ? worldFromLocal(frame, i) : vec3(0.0, 0.0, -1.0);
}

// What it reflects of light from or towards a direction; glTF takes it for smooth there.
float albedoClearcoat(Clearcoat c, vec3 wo) {
    float cosine = dot(wo, c.normal);
    return kLayering == kLayeringGltf ? reflectanceClearcoat(c.factor, cosine) : c.factor * albedoOf(albedoGgx(cosine, c.alpha), kClearcoatF0, 1.0);
}

// To layers that mirror. Of both directions the lesser share: reciprocal, and what lies below sends at most its own times (1 - F(wo)), as the extension's
// document has it for wo alone, so that both together never give more than they get, whatever lies below. (The quotient would gain over a mirror.)
float passClearcoatToMirror(float albedo_o, float albedo_i) { return 1.0 - (kLayering == kLayeringView ? albedo_o : max(albedo_o, albedo_i)); }

// To layers that spread light evenly. grazing_below: of the mean albedo of the layers below, what comes of their reflecting more at grazing angles.
float passClearcoatToDiffuse(Clearcoat c, float albedo_o, float albedo_i, float grazing_below) {
    if (kLayering != kLayeringAlbedo) return passClearcoatToMirror(albedo_o, albedo_i);
    // What comes through a layer below comes steeply, where the coat passes more than on average. For two smooth ones that is the mean of (1 - F)^2 over the
    // square of that of 1 - F, (1 - 2/21 + 1/66) / (1 - 1/21)^2; rough ones have their part in it less by as much as their grazing angles, 1/21 for smooth.
    const float kAlike = 0.0142;
    GgxAlbedo mean = meanAlbedoGgx(c.alpha);
    float alike = 1.0 + kAlike * min(21.0 * mean.grazing, 1.0) * min(21.0 * grazing_below, 1.0);
    return passedBothWays(1.0 - albedo_o, 1.0 - albedo_i, alike * (1.0 - c.factor * albedoOf(mean, kClearcoatF0, 1.0)));
}

#endif
