// Asks a lobe for the value of pairs of directions and for a sample each. Comes behind the functions that the kernel of a lobe defines:
//   LobeValue evaluateLobe(vec3 wo, vec3 wi); BsdfSample sampleLobe(vec3 wo, vec4 u);
// and behind a block of push constants with `uint count` and `uint seed`.
#include "pure/random.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Questions { vec4 directions[]; };  // wo, wi
layout(std430, binding = 1) writeonly buffer Answers { vec4 answers[]; };      // f, pdf; a sample of wi, its pdf (-1: absorbed); its weight

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    vec3 wo = directions[2u * i].xyz;
    LobeValue value = evaluateLobe(wo, directions[2u * i + 1u].xyz);
    BsdfSample s = sampleLobe(wo, random4(SampleAddress(uvec2(i & 1023u, i >> 10u), 0u, seed), 0u));
    answers[3u * i] = vec4(value.f, value.pdf);
    answers[3u * i + 1u] = vec4(s.wi, s.valid ? s.pdf : -1.0);
    answers[3u * i + 2u] = vec4(s.weight, 0.0);
}
