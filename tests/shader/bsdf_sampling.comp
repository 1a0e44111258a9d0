#version 460
#extension GL_GOOGLE_include_directive : require
// Samples of the scattering function for one outgoing direction.
#include "pure/bsdf.glsl"
#include "pure/random.glsl"

layout(local_size_x = 64) in;
layout(push_constant) uniform Push {
    vec3 diffuse;
    float alpha;
    vec3 dielectric_f0;
    float dielectric_f90;
    vec3 metal_f0;
    float metallic;
    uint count;
    uint seed;
    vec4 wo;
};
layout(std430, binding = 0) readonly buffer Questions { uint sample_index; };
layout(std430, binding = 1) writeonly buffer Answers { vec4 answers[]; };  // wi, pdf (-1: absorbed); weight; visible normal

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    Bsdf b = Bsdf(Diffuse(diffuse), plainSpecular(alpha, dielectric_f0, dielectric_f90, metal_f0, metallic), kNoClearcoat);
    SampleAddress a = SampleAddress(uvec2(i & 1023u, i >> 10u), sample_index, seed);
    vec4 u = random4(a, 0u);
    BsdfSample s = sampleBsdf(b, wo.xyz, u.x, u.yz);
    answers[3u * i] = vec4(s.wi, s.valid ? s.pdf : -1.0);
    answers[3u * i + 1u] = vec4(s.weight, 0.0);
    answers[3u * i + 2u] = vec4(sampleGgxVisibleNormal(wo.xyz, alpha, u.yz), 0.0);
}
