// A list of rays to be traced and what each hits, as ray_tracer.cpp binds them.
#ifndef LICHT_BOUND_LISTED_RAYS_GLSL
#define LICHT_BOUND_LISTED_RAYS_GLSL
#include "shared/bindings.h"
#include "shared/constants.h"
#include "shared/index.h"
#include "shared/ray_records.h"

layout(constant_id = kConstantAnyHit) const bool kAnyHit = false;
// Not push constants: some drivers compile a program again for every value that decides a branch.
layout(std430, binding = kBindingRayRange) readonly buffer Range { RayRange range; };
layout(binding = kBindingRayTexels) uniform samplerBuffer ray_texels;  // RayRecord: two texels a ray
layout(std430, binding = kBindingRayHits) writeonly buffer RayHits { RayHitRecord ray_hits[]; };  // kRayCut stays where nothing is written

bool acceptHit(uint position, float t) { return true; }
#include "bound/traversal.glsl"

uint g_ray = 0u;

void takeRay(uint i, out vec3 origin, out vec3 direction, out float t_min, out float t_max) {
    g_ray = range.first + i;
    vec4 o = texelFetch(ray_texels, int(2u * g_ray)), d = texelFetch(ray_texels, int(2u * g_ray + 1u));
    origin = o.xyz;
    t_min = o.w;
    direction = d.xyz;
    t_max = d.w;
}

void giveHit(bool gives, TraceHit found) {
    if (!gives) return;
    uint triangle = found.position == kNoIndex ? kNoIndex : bvhTriangleOrder(found.position);
    ray_hits[g_ray] = RayHitRecord(triangle, found.t, found.b1, found.b2);
}

#endif
