#version 460
#extension GL_GOOGLE_include_directive : require
// Traces a list of rays and writes what they hit.
#include "shared/ray_records.h"

layout(local_size_x = 64) in;
layout(constant_id = 80) const bool kAnyHit = false;  // kConstantAnyHit
// Not push constants: some drivers compile a program again for every value that decides a branch.
layout(std430, binding = 30) readonly buffer Range { RayRange range; };
layout(std430, binding = 31) readonly buffer Rays { RayRecord rays[]; };
layout(std430, binding = 32) writeonly buffer RayHits { RayHitRecord ray_hits[]; };

bool acceptHit(uint position, float t) { return true; }
#include "bound/traversal.glsl"

void main() {
    if (gl_GlobalInvocationID.x >= range.count) return;
    uint i = range.first + gl_GlobalInvocationID.x;
    RayRecord ray = rays[i];
    TraceHit hit = traceRay(ray.origin, ray.direction, ray.t_min, ray.t_max, kAnyHit);
    uint triangle = hit.position == kNoIndex ? kNoIndex : bvhTriangleOrder(hit.position);
    ray_hits[i] = RayHitRecord(bvh_walk_cut ? kRayCut : triangle, hit.t, hit.b1, hit.b2);
}
