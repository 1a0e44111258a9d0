#version 460
#extension GL_GOOGLE_include_directive : require
// The scattering function for pairs of directions.
#include "pure/bsdf.glsl"

layout(local_size_x = 64) in;
layout(push_constant) uniform Push {
    vec3 diffuse;
    float alpha;
    vec3 dielectric_f0;
    float dielectric_f90;
    vec3 metal_f0;
    float metallic;
    uint count;
};
layout(std430, binding = 0) readonly buffer Questions { vec4 directions[]; };  // wo, wi
layout(std430, binding = 1) writeonly buffer Answers { vec4 answers[]; };      // f, pdf; Fresnel for cos = wo.z, D for h = wo

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    Bsdf b = Bsdf(Diffuse(diffuse), plainSpecular(alpha, dielectric_f0, dielectric_f90, metal_f0, metallic), kNoClearcoat);
    vec3 wo = directions[2u * i].xyz;
    vec3 wi = directions[2u * i + 1u].xyz;
    LobeValue value = evaluateBsdf(b, wo, wi);
    answers[2u * i] = vec4(value.f, value.pdf);
    answers[2u * i + 1u] = vec4(fresnelSchlick(b.specular.f0, b.specular.f90, wo.z), ggxD(wo, alpha));
}
