#version 460
#extension GL_GOOGLE_include_directive : require
// Thin films: their Fresnel term alone, the coat and what it leaves to the base, both ways of a pair of directions, and a sample.
#include "pure/bsdf.glsl"
#include "pure/random.glsl"

layout(local_size_x = 64) in;
layout(push_constant) uniform Push { uint count; };
struct Question {
    vec3 dielectric_f0;
    float strength;
    vec3 metal_f0;
    float ior;
    vec3 diffuse;
    float thickness;
    float metallic;
    float alpha;
    float cosine;
    uint seed;
};
layout(std430, binding = 0) readonly buffer Questions { Question questions[]; };
struct Answer {
    vec4 film;     // reflectance over the dielectric base; strength that is left
    vec4 coat;     // the coat's reflectance; what reaches the base when wo and wi both have this cosine
    vec4 plain;    // the same without a film
    vec4 there;    // f, pdf
    vec4 back;
    vec4 weight;   // w: 1 when valid
};
layout(std430, binding = 1) writeonly buffer Answers { Answer answers[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    Question q = questions[i];
    Bsdf b = plainBsdf(q.diffuse * (1.0 - q.metallic), q.alpha, mix(q.dielectric_f0, q.metal_f0, q.metallic), 1.0, largest(q.dielectric_f0), 1.0);
    vec4 plain = vec4(coatReflectance(b, q.cosine), passedToBase(b, q.cosine, q.cosine));
    b.film = thinFilm(q.strength, q.ior, q.thickness);
    b.film_dielectric_f0 = q.dielectric_f0;
    b.film_metal_f0 = q.metal_f0;
    b.metallic = q.metallic;
    vec4 coat = vec4(coatReflectance(b, q.cosine), passedToBase(b, q.cosine, q.cosine));
    vec4 u = random4(SampleAddress(uvec2(i & 1023u, i >> 10u), 0u, q.seed), 0u);
    vec3 wo = vec3(sqrt(1.0 - q.cosine * q.cosine), 0.0, q.cosine);
    vec3 wi = sampleCosineHemisphere(u.yw);
    BsdfSample s = bsdfSample(b, wo, u.x, u.yz);
    answers[i] = Answer(vec4(fresnelThinFilm(b.film, filmResponse(b.film, q.cosine), q.dielectric_f0), b.film.strength), coat, plain,
                        vec4(bsdfEvaluate(b, wo, wi), bsdfPdf(b, wo, wi)), vec4(bsdfEvaluate(b, wi, wo), 0.0), vec4(s.weight, s.valid ? 1.0 : 0.0));
}
