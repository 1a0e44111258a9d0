// Where what a pixel shows was in the view before, and what that view has told of it.
// Schied et al. 2017, Spatiotemporal Variance-Guided Filtering: each tap is asked whether it shows the same surface. Zimmer et al. 2015, Path-space Motion
// Estimation and Decomposition for Robust Animation Filtering: what is mirrored moves as its image behind the mirror does.
#ifndef LICHT_HISTORY_REPROJECT_GLSL
#define LICHT_HISTORY_REPROJECT_GLSL
#include "camera/gbuffer.glsl"
#include "pure/mirror.glsl"
#include "pure/tiles.glsl"
#include "shared/signals.h"

layout(constant_id = kConstantSceneMoves) const bool kSceneMoves = false;
layout(std430, binding = kBindingPreviousVertices) readonly buffer PreviousVertices { VertexRecord previous_vertices[]; };
layout(std430, binding = kBindingPreviousInstanceTransforms) readonly buffer PreviousInstanceTransforms {
    InstanceTransformRecord previous_instance_transforms[];
};
layout(rgba32f, binding = kBindingHistory) uniform readonly image2D history;

// What is looked for in the history.
struct Wanted {
    vec3 position;   // of the surface, world, as it was
    vec3 normal;
    float instance;  // + 1
    float reach;     // metres that its plane may be off
    vec2 mirrored;   // what it mirrors as sharply as a picture: metres to it, and its instance + 1; 0: it does not
};

vec3 previousPoint(uint instance, uint vertex) {
    vec3 point = previous_vertices[vertex].position;
    if (!kInstances || instance < kBakedInstances) return point;
    InstanceTransformRecord t = previous_instance_transforms[instance - kBakedInstances];
    return vec3(dot(t.world_x, point), dot(t.world_y, point), dot(t.world_z, point)) + vec3(t.pivot_x, t.pivot_y, t.pivot_z);
}

// Where what was hit was in the view before: by the vertices and the transform that it had.
vec3 previousPosition(Hit hit) {
    if (!kSceneMoves) return hitPosition(hit);
    uvec3 v = triangleVertices(hit.instance, hit.primitive);
    return (1.0 - hit.b1 - hit.b2) * previousPoint(hit.instance, v.x) + hit.b1 * previousPoint(hit.instance, v.y) + hit.b2 * previousPoint(hit.instance, v.z);
}

vec4 historyAt(uint tile, ivec2 pixel) { return imageLoad(history, tilePlace(imageSize(history), frame.view.size, tile, uvec2(pixel))); }

// Distance along the axis of a point.
float depthIn(ViewRecord view, vec3 position) { return -dot(view.back, position - view.eye); }

// Where the middle of a pixel is at that depth.
vec3 positionIn(ViewRecord view, ivec2 pixel, float depth) {
    CameraRay ray = cameraRay(view, vec2(pixel) + 0.5);
    return ray.origin + ray.direction * (depth / -dot(view.back, ray.direction));
}

// Whether a pixel of the view before shows the surface: the same instance, on its plane, facing alike. smooth_: and nothing else beside it.
bool showsSurface(Wanted wanted, ivec2 tap, inout bool smooth_) {
    const float kFacing = 0.7;  // cosine: bumps agree, corners do not
    if (any(lessThan(tap, ivec2(0))) || any(greaterThanEqual(tap, ivec2(frame.previous_view.size)))) return false;
    vec4 place = historyAt(kHistoryPlace, tap);
    vec4 surface = historyAt(kHistorySurface, tap);
    smooth_ = smooth_ && surface.y > 0.0;
    if (place.w <= 0.0 || surface.x != wanted.instance) return false;
    // What lies behind in a mirror is as well hidden as what lies behind without one.
    const float kOffDistance = 0.25;
    float off = abs(surface.z - wanted.mirrored.x);
    if (wanted.mirrored.x > 0.0 && (surface.w != wanted.mirrored.y || off > kOffDistance * min(surface.z, wanted.mirrored.x))) return false;
    if (dot(place.xyz, wanted.normal) < kFacing) return false;
    return abs(dot(wanted.normal, positionIn(frame.previous_view, tap, place.w) - wanted.position)) < wanted.reach;
}

#endif
