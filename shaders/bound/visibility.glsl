// Rays through the scene, and whether two points see each other.
#ifndef LICHT_BOUND_VISIBILITY_GLSL
#define LICHT_BOUND_VISIBILITY_GLSL

#include "bound/surface.glsl"
#include "bound/traversal.glsl"
#include "shared/geometry.h"
#include "shared/index.h"

layout(constant_id = kEffectLightSpheres) const bool kLightSpheres = false;

// A ray on its way through the scene: surfaces that are not there for it let it pass.
struct SceneRay {
    RayQuery query;
    SampleAddress address;  // whose ray it is, and how many that sample traced before: by both the coverage of partly transparent surfaces is decided
    uint rays_before;
    Hit hit;                // what it met last
    bool truncated;         // see TraceResult
};

SceneRay sceneRay(RayQuery query, SampleAddress address, uint rays_before) { return SceneRay(query, address, rays_before, kNoHit, false); }

// Behind a surface that was not there a ray goes on at that very distance: only what comes later in the order of hits, (t, instance, triangle), counts.
bool acceptHit(RayQuery ray, uint instance, uint position, float t) {
    bool from_there = kInstances && instance != ray.from_instance ? instance + 1u > ray.from_instance + 1u : bvhTriangleOrder(position) >= ray.from_triangle;
    return !kAlpha || t > ray.t_min || from_there;
}

Hit hitOf(TraceHit t) {
    if (t.position == kNoIndex) return kNoHit;
    uint texel = t.position * kBvhTexelsPerTriangle;
    uint instance = kInstances && t.instance != kNoIndex ? kBakedInstances + t.instance : uint(bvhTriangleTexel(texel + 1u).w);
    return Hit(instance, uint(bvhTriangleTexel(texel + 2u).w), t.b1, t.b2);
}

// Is what was met not there for this ray? Then it goes on behind it. Coverage is asked once per surface and not inside the traversal, because drivers without
// branches would filter textures in every step of it.
bool passesThrough(inout SceneRay ray, TraceHit found) {
    ray.hit = hitOf(found);
    bool passes = false;
    if (kAlpha && ray.hit.instance != kNoIndex && (instanceAt(ray.hit.instance).flags & kInstanceAlpha) != 0u) {
        uint triangle = instanceAt(ray.hit.instance).first_triangle + ray.hit.primitive;
        passes = !covers(ray.hit.instance, ray.hit.primitive, ray.hit.b1, ray.hit.b2, coverageNumber(ray.address, ray.rays_before, ray.hit.instance, triangle));
        if (passes) {
            ray.query.t_min = found.t;
            ray.query.from_instance = found.instance;
            ray.query.from_triangle = triangle + 1u;
        }
    }
    return passes;
}

// Until something is met that is there for this ray.
void trace(inout SceneRay ray) {
    while (true) {
        TraceResult found = traceRay(ray.query);
        ray.truncated = ray.truncated || found.truncated;
        if (!passesThrough(ray, found.hit)) break;
    }
}

// The point moved off its plane towards `direction` by the bound of its error, so that a ray from there cannot meet the plane again.
vec3 offsetOrigin(vec3 position, vec3 normal, float error_bound, vec3 direction) {
    return position + (dot(direction, normal) < 0.0 ? -error_bound : error_bound) * normal;
}

vec3 offsetOrigin(Surface s, vec3 direction) { return offsetOrigin(s.position, s.face_normal, s.error_bound, direction); }

// A ray to a light, and what it brings when it gets there.
struct ShadowRay {
    SceneRay ray;
    uint target;  // the instance that is to be met first; kNoIndex: nothing is to be met
    vec3 light;
    bool wanted;  // false: there is no such ray
};

const SceneRay kNoSceneRay = SceneRay(kNoRayQuery, SampleAddress(uvec2(0u), 0u, 0u), 0u, kNoHit, false);
const ShadowRay kNoShadowRay = ShadowRay(kNoSceneRay, kNoIndex, vec3(0.0), false);

// The nearest surface is wanted.
RayQuery pathQuery(vec3 origin, vec3 direction) { return rayQuery(origin, direction, infinity(), 0.0); }

// t_enough: what is met nearer than that is surely not the target.
RayQuery shadowQuery(vec3 origin, vec3 direction, float t_max, float t_enough) {
    // Surfaces that may let the ray pass are asked one after the other, from the nearest on.
    return rayQuery(origin, direction, t_max, kAlpha ? 0.0 : kLightSpheres ? t_enough : infinity());
}

// Did it get there, now that it is traced?
bool arrives(ShadowRay shadow) { return kLightSpheres ? shadow.ray.hit.instance == shadow.target : shadow.ray.hit.instance == kNoIndex; }

#endif
