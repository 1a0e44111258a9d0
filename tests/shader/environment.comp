#version 460
#extension GL_GOOGLE_include_directive : require
// Samples of the environment with the densities that sampling and looking up report, and densities of given directions.
#include "light/sky.glsl"
#include "pure/sequence.glsl"

layout(local_size_x = 64) in;
layout(push_constant) uniform Push { uint count; uint given; };  // given: look the questions up instead of sampling
layout(std430, binding = kFirstFreeBinding) readonly buffer Questions { vec4 directions[]; };
layout(std430, binding = kFirstFreeBinding + 1u) writeonly buffer Answers { vec4 answers[]; };  // direction, pdf; radiance, pdf when looked up; tries

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    EnvironmentSample s;
    if (given != 0u) s = EnvironmentSample(directions[i].xyz, 0.0, 0u);
    else s = sampleEnvironment(sampleBits4(SampleAddress(uvec2(i & 1023u, i >> 10u), 0u, frame.seed), 2u));
    answers[3u * i] = vec4(s.direction, s.pdf);
    answers[3u * i + 1u] = vec4(environmentRadiance(s.direction), pdfEnvironment(s.direction));
    answers[3u * i + 2u] = vec4(float(s.tries), 0.0, 0.0, 0.0);
}
