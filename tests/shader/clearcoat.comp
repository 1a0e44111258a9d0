#version 460
#extension GL_GOOGLE_include_directive : require
// A material under a clearcoat.
#include "pure/bsdf.glsl"

layout(push_constant) uniform Push {
    uint count;
    uint seed;
    uint pad[2];
    vec3 diffuse;
    float alpha;
    vec3 f0;
    float f90;
    float factor;
    float coat_alpha;
    float tilt;      // of the coat's normal, tangent of the angle
    float metallic;  // f0 is that of the metal, too
};

Bsdf material() {
    return Bsdf(Diffuse(diffuse), plainSpecular(alpha, f0, f90, f0, metallic), Clearcoat(factor, coat_alpha, normalize(vec3(tilt, 0.5 * tilt, 1.0))));
}

LobeValue evaluateLobe(vec3 wo, vec3 wi) { return evaluateBsdf(material(), wo, wi); }
BsdfSample sampleLobe(vec3 wo, vec4 u) { return sampleBsdf(material(), wo, u.x, u.yz); }

#include "lobe_kernel.glsl"
