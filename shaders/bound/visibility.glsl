// Rays that leave surfaces, and whether two points see each other.
#ifndef LICHT_BOUND_VISIBILITY_GLSL
#define LICHT_BOUND_VISIBILITY_GLSL

#include "bound/surface.glsl"
#include "shared/geometry.h"
#include "shared/index.h"

// Whose rays are traced, and how many were before: what the coverage of partly transparent surfaces is decided by.
SampleAddress g_address;
uint g_rays_before;

// Where a ray goes on behind a surface that is not there for it: hits are ordered by (t, instance, triangle), and only later ones count.
float g_after_t = -1.0;
uint g_after_instance = 0u;
uint g_after_triangle = 0u;

// The including shader defines what else happens to a ray that is about to be traced: nothing, or a note of it.
void onRay(vec3 origin, vec3 direction, float t_max, bool any_hit);

uint bvhInstance();
uint bvhTriangleOrder(uint position);

bool acceptHit(uint position, float t) {
    bool later = kInstances && bvhInstance() != g_after_instance ? bvhInstance() + 1u > g_after_instance + 1u : bvhTriangleOrder(position) > g_after_triangle;
    return !kAlpha || t > g_after_t || later;
}

#include "bound/traversal.glsl"

Hit hitOf(TraceHit t) {
    if (t.position == kNoIndex) return kNoHit;
    uint texel = t.position * kBvhTexelsPerTriangle;
    uint instance = kInstances && t.instance != kNoIndex ? kBakedInstances + t.instance : uint(bvhTriangleTexel(texel + 1u).w);
    return Hit(instance, uint(bvhTriangleTexel(texel + 2u).w), t.b1, t.b2);
}

// What passesThrough() was asked about last.
Hit g_hit = kNoHit;

// Is what was hit not there for this ray? Then only what comes behind it counts from here on. Coverage is asked once per surface and not inside the
// traversal, because drivers without branches would filter textures in every step of it.
bool passesThrough(TraceHit found) {
    g_hit = hitOf(found);
    bool passes = false;
    if (kAlpha && g_hit.instance != kNoIndex && (instanceAt(g_hit.instance).flags & kInstanceAlpha) != 0u) {
        uint triangle = instanceAt(g_hit.instance).first_triangle + g_hit.primitive;
        passes = !covers(g_hit.instance, g_hit.primitive, g_hit.b1, g_hit.b2, coverageNumber(g_address, g_rays_before, g_hit.instance, triangle));
        if (passes) {
            g_after_t = found.t;
            g_after_instance = found.instance;
            g_after_triangle = triangle;
        }
    }
    return passes;
}

// Nearest surface, or with any_hit some surface, that is there for this ray.
Hit trace(vec3 origin, vec3 direction, float t_max, bool any_hit) {
    onRay(origin, direction, t_max, any_hit);
    g_after_t = -1.0;
    float t_min = 0.0;
    while (true) {
        TraceHit found = traceRay(origin, direction, t_min, t_max, any_hit && !kAlpha);
        if (!passesThrough(found)) break;
        t_min = found.t;
    }
    ++g_rays_before;
    return g_hit;
}

// The point moved off its plane towards `direction` by the bound of its error, so that a ray from there cannot meet the plane again.
vec3 offsetOrigin(vec3 position, vec3 normal, float error_bound, vec3 direction) {
    return position + (dot(direction, normal) < 0.0 ? -error_bound : error_bound) * normal;
}

vec3 offsetOrigin(Surface s, vec3 direction) { return offsetOrigin(s.position, s.face_normal, s.error_bound, direction); }

// A ray as it is asked for; `wanted` false: it is not.
struct RayQuery {
    vec3 origin;
    vec3 direction;
    float t_max;
    bool wanted;
    uint target;     // of a ray to a light: the instance that is to be met first; kNoIndex: nothing is to be met
    float t_enough;  // what is met before is surely not the target
};

const RayQuery kNoRayQuery = RayQuery(vec3(0.0), vec3(0.0), 0.0, false, kNoIndex, 0.0);

Hit traceNearest(vec3 origin, vec3 direction) { return trace(origin, direction, uintBitsToFloat(0x7f800000u), false); }

void seekTarget(uint target, float t_enough) { bvh_any_before = target == kNoIndex ? uintBitsToFloat(0x7f800000u) : t_enough; }

// Does a ray to a light get there?
bool lightArrives(RayQuery ray) {
    seekTarget(ray.target, ray.t_enough);
    return trace(ray.origin, ray.direction, ray.t_max, true).instance == ray.target;
}

#endif
