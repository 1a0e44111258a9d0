// What else happens to what a path finds: notes by order, and by the lobes of its first vertex.
#ifndef LICHT_PATH_WATCH_GLSL
#define LICHT_PATH_WATCH_GLSL
#include "path/orders.glsl"
#include "path/signals.glsl"

void onLight(uvec2 pixel, uint order, uint way, vec3 kept, vec3 lost) {
    noteOrder(pixel, order, kept, lost);
    if (kSignals) noteSignal(pixel, order, way, kept);
}

void onRays(uvec2 pixel, uint order, uint rays) { noteRays(pixel, order, rays); }

void onFirstVertex(uvec2 pixel, Surface s, vec3 wo_local) { noteFirstVertex(pixel, s, wo_local); }

void onSecondVertex(uvec2 pixel, uint instance, float distance_) { noteSecondVertex(pixel, instance, distance_); }

void onFirstWay(uvec2 pixel, uint way, vec3 share_of_spread) { noteFirstWay(pixel, way, share_of_spread); }

#endif
