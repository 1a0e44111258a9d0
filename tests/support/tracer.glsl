// A list of rays to be traced, as tracer.cpp binds it.
layout(local_size_x = 64) in;

layout(push_constant) uniform Push {
    uint ray_count;
    uint any_hit;
    uint refused;  // acceptHit refuses positions that this divides; 0: none
    uint stride;   // not 0: ray i accepts position i * stride alone
} push;

uint g_ray = 0u;

bool acceptHit(uint position, float t) {
    bool wanted = push.stride == 0u || position == g_ray * push.stride;
    return wanted && (push.refused == 0u || position % push.refused != 0u);
}
#include "bound/traversal.glsl"

layout(binding = kFirstFreeBinding, std430) readonly buffer rays { vec4 ray_data[]; };   // origin, t_min; direction, t_max
layout(binding = kFirstFreeBinding + 1u, std430) writeonly buffer hits { vec4 hit_data[]; };  // position as bits, t, b1, b2; left alone where the walk was cut

void takeRay(uint i, out vec3 origin, out vec3 direction, out float t_min, out float t_max) {
    g_ray = i;
    vec4 o = ray_data[2u * i], d = ray_data[2u * i + 1u];
    origin = o.xyz;
    t_min = o.w;
    direction = d.xyz;
    t_max = d.w;
}

void giveHit(bool gives, TraceHit found) {
    if (gives) hit_data[g_ray] = vec4(uintBitsToFloat(found.position), found.t, found.b1, found.b2);
}
