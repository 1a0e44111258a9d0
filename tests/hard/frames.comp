#version 460
#extension GL_GOOGLE_include_directive : require
// The local frame around each normal.
#include "pure/frame.glsl"

layout(local_size_x = 64) in;
layout(push_constant) uniform Push { uint count; } push;
layout(std430, binding = 0) readonly buffer Questions { vec4 normals[]; };
layout(std430, binding = 1) writeonly buffer Answers { vec4 axes[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    Frame f = frameFromNormal(normals[i].xyz);
    axes[2u * i] = vec4(f.tangent, 0.0);
    axes[2u * i + 1u] = vec4(f.bitangent, 0.0);
}
