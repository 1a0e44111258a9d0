// Traces a list of rays and writes what they hit: lanes whose ray has ended take the next one.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "tracer.glsl"

#include "ray/list.glsl"

layout(binding = kFirstFreeBinding + 2u, std430) buffer truncated { uint truncated_traversals; };

void main() {
    uint n = traceList(push.ray_count);
    if (n > 0u) atomicAdd(truncated_traversals, n);
}
