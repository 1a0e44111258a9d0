#version 460
#extension GL_GOOGLE_include_directive : require
// There and back: (u, v) of a direction, and the direction of that again.
#include "pure/latlong.glsl"

layout(local_size_x = 64) in;
layout(push_constant) uniform Push { uint count; };
layout(std430, binding = 0) readonly buffer Questions { vec4 directions[]; };
layout(std430, binding = 1) writeonly buffer Answers { vec4 answers[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    vec3 d = directions[i].xyz;
    vec2 uv = latlongFromDirection(d);
    answers[2u * i] = vec4(uv, 0.0, 0.0);
    answers[2u * i + 1u] = vec4(directionFromLatlong(uv.x, d.y), 0.0);
}
