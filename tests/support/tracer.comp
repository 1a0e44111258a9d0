// Traces a list of rays and writes what they hit: a ray a thread.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tracer.glsl"

void main() {
    if (gl_GlobalInvocationID.x >= push.ray_count) return;
    vec3 origin, direction;
    float t_min, t_max;
    takeRay(gl_GlobalInvocationID.x, origin, direction, t_min, t_max);
    TraceHit found = traceRay(origin, direction, t_min, t_max, push.any_hit != 0u);
    giveHit(!bvh_walk_cut, found);
}
