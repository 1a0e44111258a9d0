#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
// Traces a list of rays and writes what they hit: lanes whose ray has ended take the next one.
#include "ray/listed.glsl"

layout(local_size_x = 64) in;

#include "ray/list.glsl"

void main() { traceList(range.count); }
