#version 460
#extension GL_GOOGLE_include_directive : require
// The curves for a list of colours: display light before the clamp to [0,1], then encoded.
#include "pure/tonemap.glsl"
#include "shared/choices.h"
#include "shared/transfer.h"

layout(local_size_x = 64) in;
layout(push_constant) uniform Push { uint count; uint curve; };
layout(std430, binding = 0) readonly buffer Questions { vec4 colors[]; };
layout(std430, binding = 1) writeonly buffer Answers { vec4 answers[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    vec3 c = clamp(colors[i].rgb, vec3(0.0), vec3(1e30));
    if (curve == kTonemapNeutral) c = tonemapNeutral(c);
    if (curve == kTonemapAgx) c = tonemapAgx(c);
    if (curve == kTonemapAces) c = tonemapAces(c);
    answers[2u * i] = vec4(c, 0.0);
    c = clamp(c, vec3(0.0), vec3(1.0));
    answers[2u * i + 1u] = vec4(srgbFromLinear(c.r), srgbFromLinear(c.g), srgbFromLinear(c.b), 1.0);
}
