// Traces a list of rays and writes what they hit: lanes whose ray has ended take the next one.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "tracer.glsl"

bool passesThrough(TraceHit found) { return false; }
#include "bound/ray_list.glsl"

layout(binding = kFirstFreeBinding + 2u, std430) buffer lost { uint lost_rays; };

void main() {
    uint n = traceList(push.ray_count, push.any_hit != 0u);
    if (n > 0u) atomicAdd(lost_rays, n);
}
