// Traces a list of rays and writes what they hit.
#version 460
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 64) in;

layout(push_constant) uniform Push {
    uint ray_count;
    uint any_hit;
    uint refused;  // acceptHit refuses positions that this divides; 0: none
    uint stride;   // not 0: ray i accepts position i * stride alone
} push;

bool acceptHit(uint position, float t) {
    bool wanted = push.stride == 0u || position == gl_GlobalInvocationID.x * push.stride;
    return wanted && (push.refused == 0u || position % push.refused != 0u);
}
#include "bound/traversal.glsl"

const uint kCut = 0xfffffffeu;

layout(binding = 0, std430) readonly buffer rays { vec4 ray_data[]; };   // origin, t_min; direction, t_max
layout(binding = 1, std430) writeonly buffer hits { vec4 hit_data[]; };  // position as bits (kCut: the walk was cut), t, b1, b2

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.ray_count) {
        return;
    }
    vec4 origin = ray_data[2u * i];
    vec4 direction = ray_data[2u * i + 1u];
    TraceHit hit = traceRay(origin.xyz, direction.xyz, origin.w, direction.w, push.any_hit != 0u);
    hit_data[i] = vec4(uintBitsToFloat(bvh_walk_cut ? kCut : hit.position), hit.t, hit.b1, hit.b2);
}
