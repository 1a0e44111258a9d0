#version 460
#extension GL_GOOGLE_include_directive : require
// Solid angles of shapes and directions to them, one shape and two uniform numbers a thread.
#include "pure/frame.glsl"
#include "pure/spherical.glsl"

struct Question {
    vec3 a, b, c;  // vertices; corner and edges; or in a.x the square of the sine of a cone's half angle, with its axis in b and, for 5, a
                   // direction in c; or (y, x) of an angle in a.xy
    vec2 u;
};

layout(local_size_x = 64) in;
layout(push_constant) uniform Push {
    uint count;
    uint shape;  // 0 triangle, 1 rectangle, 2 cone, 3 arctangent, 4 the limits of solid angle sampling, 5 inside a cone, drawn or given
};
layout(std430, binding = 0) readonly buffer Questions { Question questions[]; };
layout(std430, binding = 1) writeonly buffer Answers { vec4 answers[]; };  // direction or point, solid angle

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    Question q = questions[i];
    vec4 answer = vec4(0.0);
    if (shape == 0u) answer = vec4(sampleTriangleSolidAngle(q.a, q.b, q.c, q.u), solidAngleTriangle(q.a, q.b, q.c));
    if (shape == 1u) answer = vec4(sampleRectangleSolidAngle(q.a, q.b, q.c, q.u), solidAngleRectangle(q.a, q.b, q.c));
    if (shape == 2u) answer = vec4(sampleCone(q.a.x, q.u), solidAngleCone(q.a.x));
    if (shape == 3u) answer.x = arctangent(q.a.x, q.a.y);
    if (shape == 4u) answer.xy = vec2(kSmallestSolidAngle, kLargestSolidAngle);
    if (shape == 5u) {
        vec3 w = q.c == vec3(0.0) ? worldFromLocal(frameFromNormal(q.b), sampleCone(q.a.x, q.u)) : q.c;
        answer = vec4(w, insideCone(q.b, q.a.x, w) ? 1.0 : 0.0);
    }
    answers[i] = answer;
}
