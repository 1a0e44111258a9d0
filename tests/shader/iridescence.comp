#version 460
#extension GL_GOOGLE_include_directive : require
// Thin films: their Fresnel term alone, the specular layer and what it leaves to the diffuse layer, both ways of a pair of directions, and a sample.
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
    vec4 film;      // reflectance over the dielectric base; strength that is left
    vec4 specular;  // the layer's reflectance; what it passes when wo and wi both have this cosine
    vec4 plain;     // the same without a film
    vec4 there;     // f, pdf
    vec4 back;
    vec4 weight;    // w: 1 when valid
};
layout(std430, binding = 1) writeonly buffer Answers { Answer answers[]; };

// Both ways at that angle.
float passed(Specular s, float cosine) {
    GgxAlbedo a = albedoGgx(cosine, s.alpha);
    return passSpecular(s, cosine, a, a, meanAlbedoGgx(s.alpha));
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    Question q = questions[i];
    Specular layer = plainSpecular(q.alpha, q.dielectric_f0, 1.0, q.metal_f0, q.metallic);
    vec4 plain = vec4(reflectanceSpecular(layer, q.cosine), passed(layer, q.cosine));
    layer.thin_film = thinFilm(q.strength, q.ior, q.thickness);
    vec4 specular = vec4(reflectanceSpecular(layer, q.cosine), passed(layer, q.cosine));
    Bsdf b = Bsdf(Diffuse(q.diffuse * (1.0 - q.metallic)), layer, kNoClearcoat);
    vec4 u = random4(SampleAddress(uvec2(i & 1023u, i >> 10u), 0u, q.seed), 0u);
    vec3 wo = vec3(sqrt(1.0 - q.cosine * q.cosine), 0.0, q.cosine);
    vec3 wi = sampleCosineHemisphere(u.yw);
    LobeValue there = evaluateBsdf(b, wo, wi);
    BsdfSample s = sampleBsdf(b, wo, u.x, u.yz);
    vec3 film = fresnelThinFilm(layer.thin_film, thinFilmResponse(layer.thin_film, q.cosine), q.dielectric_f0);
    answers[i] = Answer(vec4(film, layer.thin_film.strength), specular, plain, vec4(there.f, there.pdf), vec4(evaluateBsdf(b, wi, wo).f, 0.0),
                        vec4(s.weight, s.valid ? 1.0 : 0.0));
}
