#version 460
#extension GL_GOOGLE_include_directive : require
// The sequences as they are. Threads that go over pixels lie on a picture 1024 pixels wide, so that neighbours are neighbours there.
#include "pure/sequence.glsl"

layout(local_size_x = 64) in;
layout(push_constant) uniform Push {
    uint count;
    uint what;       // 0 numbers, 1 a question's words as uniform numbers, 2 sums of functions over kSummed samples
    uint index;
    uint dimension;
    uint seed;
    uint varies;     // what the thread's number goes to: 0 the pixel, 1 the sample's index, 2 the dimension, 3 the seed
    uint samples;    // of a pixel, when summing
};
layout(std430, binding = 0) readonly buffer Questions { uvec4 words[]; };
layout(std430, binding = 1) writeonly buffer Answers { vec4 answers[]; };

const uint kSummed = 16u;

vec2 smoothBump(vec4 u) {
    vec4 s = u * (1.0 - u);
    return 36.0 * s.xz * s.yw;  // mean one
}

vec2 quarterDisc(vec4 u) { return vec2(dot(u.xy, u.xy) < 1.0 ? 1.0 : 0.0, dot(u.zw, u.zw) < 1.0 ? 1.0 : 0.0); }

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    SampleAddress a = SampleAddress(uvec2(17u, 4u), index, seed);
    uint d = dimension;
    if (what == 2u) {
        uint first = i * kSummed;
        a.pixel = uvec2(first / samples, 0u);
        a.seed += first / samples;  // pixels of blue noise would share one
        a.index += first % samples;
        vec4 sums = vec4(0.0);
        for (uint k = 0u; k < kSummed; ++k) {
            vec4 u = sample4(a, d);
            sums += vec4(smoothBump(u), quarterDisc(u));
            ++a.index;
        }
        answers[i] = sums;
        return;
    }
    if (varies == 0u) a.pixel = uvec2(i & 1023u, i >> 10u);
    if (varies == 1u) a.index += i;
    if (varies == 2u) d += i;
    if (varies == 3u) a.seed += i;
    answers[i] = what == 1u ? uniformFromBits(words[i]) : sample4(a, d);
}
