#version 460
#extension GL_GOOGLE_include_directive : require
// The lobes one by one, and the whole of a material.
#include "pure/bsdf.glsl"

layout(push_constant) uniform Push {
    uint count;
    uint seed;
    uint pad[2];
    vec3 diffuse;
    float alpha;
    vec3 f0;
    float f90;
    float thickness;  // of a thin film; 0: none
    uint lobe;        // 0 diffuse, 1 specular, 2 both
    float metallic;   // f0 is that of the metal, too
};

Bsdf material() {
    Bsdf b = Bsdf(Diffuse(diffuse), plainSpecular(alpha, f0, f90, f0, metallic), kNoClearcoat);
    b.specular.thin_film = thinFilm(0.8, 1.4, thickness);
    return b;
}

BsdfSample sampleOf(vec3 wo, vec3 wi, LobeValue value) {
    bool valid = value.pdf > 0.0;
    return BsdfSample(wi, value.pdf, valid ? value.f * (wi.z / value.pdf) : vec3(0.0), valid);
}

LobeValue evaluateLobe(vec3 wo, vec3 wi) {
    if (!sameSide(wo, wi)) return kNothing;
    if (lobe == 0u) return evaluateDiffuse(material().diffuse, wi, 1.0);
    if (lobe == 1u) return evaluateSpecular(material().specular, wo, wi, normalize(wo + wi));
    return evaluateBsdf(material(), wo, wi);
}

BsdfSample sampleLobe(vec3 wo, vec4 u) {
    if (lobe == 2u) return sampleBsdf(material(), wo, u.x, u.yz);
    vec3 wi = lobe == 0u ? sampleDiffuse(u.yz) : sampleSpecular(material().specular, wo, u.yz);
    return sampleOf(wo, wi, evaluateLobe(wo, wi));
}

#include "lobe_kernel.glsl"
