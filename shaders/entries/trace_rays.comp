#version 460
#extension GL_GOOGLE_include_directive : require
// Traces a list of rays and writes what they hit: a ray a thread.
#include "bound/listed_rays.glsl"

layout(local_size_x = 64) in;

void main() {
    if (gl_GlobalInvocationID.x >= range.count) return;
    vec3 origin, direction;
    float t_min, t_max;
    takeRay(gl_GlobalInvocationID.x, origin, direction, t_min, t_max);
    TraceHit found = traceRay(origin, direction, t_min, t_max, kAnyHit);
    giveHit(!bvh_walk_cut, found);
}
