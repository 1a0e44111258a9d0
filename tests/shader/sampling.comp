#version 460
#extension GL_GOOGLE_include_directive : require
// The warps of pure/sampling.glsl.
#include "pure/random.glsl"
#include "pure/sampling.glsl"

layout(local_size_x = 64) in;
layout(push_constant) uniform Push {
    uint count;
    uint shape;  // 1 disc, 2 cosine hemisphere, 3 sphere, 4 triangle, 5 circle, 6 hemisphere, 7 ball; by rejection 8 disc, 9 ball, 10 hemisphere, 11 cosine hemisphere
    uint seed;
};
layout(std430, binding = 0) readonly buffer Questions { uvec4 words[]; };
layout(std430, binding = 1) writeonly buffer Answers { vec4 answers[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    uvec4 bits = randomBits4(SampleAddress(uvec2(i & 1023u, i >> 10u), 3u, seed), 1u);
    vec4 u = uniformFromBits(bits);
    uint tries = 0u;
    vec4 answer = vec4(0.0);
    if (shape == 1u) answer = vec4(sampleDisc(u.xy), 0.0, 0.0);
    if (shape == 2u) {
        vec3 w = sampleCosineHemisphere(u.xy);
        answer = vec4(w, pdfCosineHemisphere(w.z));
    }
    if (shape == 3u) answer = vec4(sampleUniformSphere(u.xy), 0.0);
    if (shape == 4u) answer = vec4(sampleTriangle(u.xy), 0.0, 0.0);
    if (shape == 5u) answer = vec4(unitCircle(u.x), u.x, 0.0);
    if (shape == 6u) answer = vec4(sampleUniformHemisphere(u.xy), 0.0);
    if (shape == 7u) answer = vec4(sampleBall(u.xyz), 0.0);
    if (shape == 8u) answer = vec4(sampleDiscByRejection(bits, tries), 0.0, 0.0);
    if (shape == 9u) answer = vec4(sampleBallByRejection(bits, tries), 0.0);
    if (shape == 10u) answer = vec4(sampleHemisphereByRejection(bits, tries), 0.0);
    if (shape == 11u) answer = vec4(sampleCosineHemisphereByRejection(bits, tries), 0.0);
    if (shape >= 8u) answer.w = float(tries);
    answers[i] = answer;
}
