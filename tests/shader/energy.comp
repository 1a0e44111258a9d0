#version 460
#extension GL_GOOGLE_include_directive : require
// What a material spreads evenly, and the albedos of rough microfacets that this is balanced by.
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
layout(std430, binding = 0) readonly buffer Questions { vec2 cosines[]; };  // of wo and wi
layout(std430, binding = 1) writeonly buffer Answers { vec4 answers[]; };   // f; albedo of wo, white and grazing, and both means

vec3 directionAt(float cosine) { return vec3(sqrt(1.0 - cosine * cosine), 0.0, cosine); }

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    Bsdf b = Bsdf(Diffuse(diffuse), plainSpecular(alpha, dielectric_f0, dielectric_f90, metal_f0, metallic), kNoClearcoat);
    vec3 wo = directionAt(cosines[i].x), wi = directionAt(cosines[i].y);
    GgxAlbedo albedo = albedoGgx(wo.z, alpha), mean = meanAlbedoGgx(alpha);
    answers[2u * i] = vec4(evaluateSpread(b, wo, wi, normalize(wo + wi)).f, 0.0);
    answers[2u * i + 1u] = vec4(albedo.white, albedo.grazing, mean.white, mean.grazing);
}
