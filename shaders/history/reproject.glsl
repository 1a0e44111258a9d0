// Where what a pixel shows was in the view before, and what that view has told of it.
// Schied et al. 2017, Spatiotemporal Variance-Guided Filtering: each tap is asked whether it shows the same surface. Zimmer et al. 2015, Path-space Motion
// Estimation and Decomposition for Robust Animation Filtering: what is mirrored moves as its image behind the mirror does.
#ifndef LICHT_HISTORY_REPROJECT_GLSL
#define LICHT_HISTORY_REPROJECT_GLSL
#include "camera/gbuffer.glsl"
#include "pure/tiles.glsl"
#include "shared/signals.h"

layout(rgba32f, binding = kBindingHistory) uniform readonly image2D history;

// What is looked for in the history.
struct Wanted {
    vec3 position;   // of the surface, world, as it was
    vec3 normal;
    float instance;  // + 1
    float reach;     // metres that its plane may be off
};

vec4 historyAt(uint tile, ivec2 pixel) { return imageLoad(history, tilePlace(imageSize(history), frame.view.size, tile, uvec2(pixel))); }

// Distance along the axis of a point.
float depthIn(ViewRecord view, vec3 position) { return -dot(view.back, position - view.eye); }

// Where the middle of a pixel is at that depth.
vec3 positionIn(ViewRecord view, ivec2 pixel, float depth) {
    CameraRay ray = cameraRay(view, vec2(pixel) + 0.5);
    return ray.origin + ray.direction * (depth / -dot(view.back, ray.direction));
}

// Whether a pixel of the view before shows the surface: the same instance, on its plane, facing alike.
bool showsSurface(Wanted wanted, ivec2 tap) {
    const float kFacing = 0.7;  // cosine: bumps agree, corners do not
    if (any(lessThan(tap, ivec2(0))) || any(greaterThanEqual(tap, ivec2(frame.previous_view.size)))) return false;
    vec4 place = historyAt(kHistoryPlace, tap);
    if (place.w <= 0.0 || historyAt(kHistorySurface, tap).x != wanted.instance) return false;
    if (dot(place.xyz, wanted.normal) < kFacing) return false;
    return abs(dot(wanted.normal, positionIn(frame.previous_view, tap, place.w) - wanted.position)) < wanted.reach;
}

#endif
