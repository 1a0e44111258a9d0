// Rays through the scene, and whether two points see each other.
#ifndef LICHT_RAY_VISIBILITY_GLSL
#define LICHT_RAY_VISIBILITY_GLSL

#include "bound/surface.glsl"
#include "ray/traversal.glsl"
#include "shared/geometry.h"
#include "shared/index.h"

layout(constant_id = kEffectLightSpheres) const bool kLightSpheres = false;

// A ray on its way through the scene: surfaces that are not there for it let it pass.
struct SceneRay {
    RayQuery query;
    SampleAddress address;  // whose ray it is, and which of its rays (dimensions.h): by both the coverage of partly transparent surfaces is decided
    uint number;
    Hit hit;                // what it met last
    vec3 transmittance;     // of what it has passed
    bool truncated;         // see TraceResult
};

SceneRay sceneRay(RayQuery query, SampleAddress address, uint number) {
    return SceneRay(query, address, number, kNoHit, vec3(1.0), false);
}

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

// What a surface lets pass of light that goes straight on: by its coverage all or nothing, as one number decides.
vec3 transmittanceOf(SceneRay ray, uint triangle) {
    float u = coverageNumber(ray.address, ray.number, ray.hit.instance, triangle);
    return passesAlphaTest(ray.hit.instance, ray.hit.primitive, ray.hit.b1, ray.hit.b2, u) ? vec3(0.0) : vec3(1.0);
}

// Does the ray go on behind what it met? That is asked once per surface and not inside the traversal, because drivers without branches would filter textures
// in every step of it.
bool passesThrough(inout SceneRay ray, TraceHit found) {
    ray.hit = hitOf(found);
    if (!kAlpha || ray.hit.instance == kNoIndex || (instanceAt(ray.hit.instance).flags & kInstanceAlpha) == 0u) return false;
    uint triangle = instanceAt(ray.hit.instance).first_triangle + ray.hit.primitive;
    vec3 transmittance = transmittanceOf(ray, triangle);
    if (largest(transmittance) <= 0.0) return false;
    ray.transmittance *= transmittance;
    ray.query.t_min = found.t;
    ray.query.from_instance = found.instance;
    ray.query.from_triangle = triangle + 1u;
    return true;
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

// Where rays leave from: a point of a surface or, with no bound, one in a medium.
struct Vertex {
    vec3 position;
    vec3 face_normal;   // see Surface
    float error_bound;
};

Vertex vertexOn(Surface s) { return Vertex(s.position, s.face_normal, s.error_bound); }

vec3 offsetOrigin(Vertex v, vec3 direction) { return offsetOrigin(v.position, v.face_normal, v.error_bound, direction); }

// A ray to a light, and what it brings when it gets there.
struct ShadowRay {
    SceneRay ray;
    uint target;  // the instance that is to be met first; kNoIndex: nothing is to be met
    vec3 light;
    bool wanted;  // false: there is no such ray
};

const SceneRay kNoSceneRay = SceneRay(kNoRayQuery, SampleAddress(uvec2(0u), 0u, 0u), 0u, kNoHit, vec3(1.0), false);
const ShadowRay kNoShadowRay = ShadowRay(kNoSceneRay, kNoIndex, vec3(0.0), false);

// The nearest surface is wanted.
RayQuery pathQuery(vec3 origin, vec3 direction) { return rayQuery(origin, direction, infinity(), 0.0); }

// t_enough: what is met nearer than that is surely not the target.
RayQuery shadowQuery(vec3 origin, vec3 direction, float t_max, float t_enough) {
    // Surfaces that may let the ray pass are asked one after the other, from the nearest on.
    return rayQuery(origin, direction, t_max, kAlpha ? 0.0 : kLightSpheres ? t_enough : infinity());
}

// How much of the light gets there, now that the ray is traced.
vec3 arrivingShare(ShadowRay shadow) {
    bool arrives = kLightSpheres ? shadow.ray.hit.instance == shadow.target : shadow.ray.hit.instance == kNoIndex;
    return !arrives ? vec3(0.0) : kAlpha ? shadow.ray.transmittance : vec3(1.0);
}

#endif
