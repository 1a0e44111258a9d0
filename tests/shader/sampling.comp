#version 460
#extension GL_GOOGLE_include_directive : require
// Uniform numbers and the warps of pure/sampling.glsl. Threads lie on a picture 1024 pixels wide, so that neighbours are neighbours there.
#include "pure/random.glsl"
#include "pure/sampling.glsl"

layout(local_size_x = 64) in;
layout(push_constant) uniform Push {
    uint count;
    uint shape;      // 0 sample4, 1 disc, 2 cosine hemisphere, 3 sphere, 4 triangle, 5 circle, 6 a question's words as uniform numbers
    uint index;
    uint dimension;
    uint seed;
    uint varies;     // what the thread's number goes to: 0 the pixel, 1 the sample's index, 2 the dimension, 3 the seed
};
layout(std430, binding = 0) readonly buffer Questions { uvec4 words[]; };
layout(std430, binding = 1) writeonly buffer Answers { vec4 answers[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    SampleAddress a = SampleAddress(uvec2(17u, 4u), index, seed);
    uint d = dimension;
    if (varies == 0u) a.pixel = uvec2(i & 1023u, i >> 10u);
    if (varies == 1u) a.index += i;
    if (varies == 2u) d += i;
    if (varies == 3u) a.seed += i;
    vec4 u = sample4(a, d);
    vec4 answer = u;
    if (shape == 1u) answer = vec4(sampleDisc(u.xy), 0.0, 0.0);
    if (shape == 2u) {
        vec3 w = sampleCosineHemisphere(u.xy);
        answer = vec4(w, pdfCosineHemisphere(w.z));
    }
    if (shape == 3u) answer = vec4(sampleUniformSphere(u.xy), 0.0);
    if (shape == 4u) answer = vec4(sampleTriangle(u.xy), 0.0, 0.0);
    if (shape == 5u) answer = vec4(unitCircle(u.x), u.x, 0.0);
    if (shape == 6u) answer = uniformFromBits(words[i]);
    answers[i] = answer;
}
