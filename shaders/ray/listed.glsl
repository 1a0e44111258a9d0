// A list of rays to be traced and what each hits, as ray_tracer.cpp binds them.
#ifndef LICHT_RAY_LISTED_GLSL
#define LICHT_RAY_LISTED_GLSL
#include "shared/bindings.h"
#include "shared/constants.h"
#include "shared/index.h"
#include "shared/ray_records.h"

layout(constant_id = kConstantAnyHit) const bool kAnyHit = false;
// Not push constants: some drivers compile a program again for every value that decides a branch.
layout(std430, binding = kBindingRayRange) readonly buffer Range { RayRange range; };
layout(binding = kBindingRayTexels) uniform samplerBuffer ray_texels;  // RayRecord: two texels a ray
layout(std430, binding = kBindingRayHits) writeonly buffer RayHits { RayHitRecord ray_hits[]; };  // kRayTruncated stays where nothing is written

#include "ray/traversal.glsl"

bool acceptHit(RayQuery ray, uint instance, uint position, float t) { return true; }

struct RayTask {
    RayQuery query;
    uint ray;  // of the list
    TraceHit hit;
};

RayTask takeTask(uint i) {
    uint ray = range.first + i;
    vec4 o = texelFetch(ray_texels, int(2u * ray)), d = texelFetch(ray_texels, int(2u * ray + 1u));
    RayQuery query = rayQuery(o.xyz, d.xyz, d.w, kAnyHit ? infinity() : 0.0);
    query.t_min = o.w;
    return RayTask(query, ray, kNoTraceHit);
}

RayQuery queryOf(RayTask task) { return task.query; }

bool passesThrough(inout RayTask task, TraceHit found) {
    task.hit = found;
    return false;
}

void endTask(bool ends, RayTask task) {
    if (!ends) return;
    uint triangle = task.hit.position == kNoIndex ? kNoIndex : bvhTriangleOrder(task.hit.position);
    ray_hits[task.ray] = RayHitRecord(triangle, task.hit.t, task.hit.b1, task.hit.b2);
}

#endif
