#version 460
#extension GL_GOOGLE_include_directive : require
// Adds values to running means, one a thread, and to a plain fp32 mean beside it.
#include "pure/running_mean.glsl"

layout(local_size_x = 64) in;
layout(push_constant) uniform Push {
    uint threads;
    uint count;         // values that each thread adds
    uint count_before;  // values already in the mean
    uint stride;        // between one thread's values; 0: all add the same value again and again
    vec4 mean_before;
};
layout(std430, binding = 0) readonly buffer Questions { vec4 values[]; };
layout(std430, binding = 1) writeonly buffer Answers { vec4 answers[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= threads) return;
    RunningMean r = RunningMean(TwoFloat4(mean_before, vec4(0.0)), TwoFloat4(vec4(0.0), vec4(0.0)));
    vec4 naive = mean_before;
    for (uint k = 0u; k < count; ++k) {
        vec4 value = values[i + k * stride];
        float n = float(count_before + k) + 1.0;
        r = addSample(r, value, n);
        naive += (value - naive) / n;
    }
    answers[5u * i] = r.mean.high;
    answers[5u * i + 1u] = r.mean.low;
    answers[5u * i + 2u] = r.squares.high;
    answers[5u * i + 3u] = r.squares.low;
    answers[5u * i + 4u] = naive;
}
