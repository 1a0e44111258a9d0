// Rays that leave surfaces, and whether two points see each other.
#ifndef LICHT_BOUND_VISIBILITY_GLSL
#define LICHT_BOUND_VISIBILITY_GLSL

#include "bound/surface.glsl"

layout(std430, binding = 15) readonly buffer TriangleInstances { uint triangle_instances[]; };

// What the traversal's candidates are judged by; set before a ray is traced.
SampleAddress g_address;
uint g_rays_before;

uint bvhTriangleOrder(uint position);

bool acceptHit(uint position, float b1, float b2) {
    if (!kAlpha) return true;
    uint triangle = bvhTriangleOrder(position);
    uint instance = triangle_instances[triangle];
    if ((instances[instance].flags & kInstanceAlpha) == 0u) return true;
    return covers(instance, triangle - instances[instance].first_triangle, b1, b2, coverageNumber(g_address, g_rays_before, triangle));
}

#include "bound/traversal.glsl"

// The point moved off its plane towards `direction` by the bound of its error, so that a ray from there cannot meet the plane again.
vec3 offsetOrigin(Surface s, vec3 direction) {
    return s.position + (dot(direction, s.face_normal) < 0.0 ? -s.error_bound : s.error_bound) * s.face_normal;
}

Hit traceNearest(vec3 origin, vec3 direction) {
    TraceHit t = traceRay(origin, direction, 0.0, uintBitsToFloat(0x7f800000u), false);
    ++g_rays_before;
    if (t.position == kNoIndex) return kNoHit;
    uint triangle = bvhTriangleOrder(t.position);
    uint instance = triangle_instances[triangle];
    return Hit(instance, triangle - instances[instance].first_triangle, t.b1, t.b2);
}

// Is anything between origin and origin + t_max * direction?
bool occluded(vec3 origin, vec3 direction, float t_max) {
    TraceHit t = traceRay(origin, direction, 0.0, t_max, true);
    ++g_rays_before;
    return t.position != kNoIndex;
}

#endif
