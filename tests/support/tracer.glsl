// A list of rays to be traced, as tracer.cpp binds it.
layout(local_size_x = 64) in;

layout(push_constant) uniform Push {
    uint ray_count;
    float t_enough;
    uint refused;  // acceptHit refuses positions that this divides; 0: none
    uint stride;   // not 0: ray i accepts position i * stride alone
} push;

#include "ray/traversal.glsl"

layout(binding = kFirstFreeBinding, std430) readonly buffer rays { vec4 ray_data[]; };   // origin, t_min; direction, t_max
layout(binding = kFirstFreeBinding + 1u, std430) writeonly buffer hits { vec4 hit_data[]; };  // position as bits, t, b1, b2; left alone where truncated

struct RayTask {
    RayQuery query;
    uint ray;
    TraceHit hit;
};

// A ray's number rides in a member that nothing else reads here.
bool acceptHit(RayQuery ray, uint instance, uint position, float t) {
    bool wanted = push.stride == 0u || position == ray.from_triangle * push.stride;
    return wanted && (push.refused == 0u || position % push.refused != 0u);
}

RayTask takeTask(uint i) {
    vec4 o = ray_data[2u * i], d = ray_data[2u * i + 1u];
    RayQuery query = RayQuery(o.xyz, d.xyz, o.w, d.w, push.t_enough, kNoIndex, i);
    return RayTask(query, i, kNoTraceHit);
}

RayQuery queryOf(RayTask task) { return task.query; }

bool passesThrough(inout RayTask task, TraceHit found) {
    task.hit = found;
    return false;
}

void endTask(bool ends, RayTask task) {
    if (ends) hit_data[task.ray] = vec4(uintBitsToFloat(task.hit.position), task.hit.t, task.hit.b1, task.hit.b2);
}
