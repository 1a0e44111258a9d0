// Nothing else happens to what a path finds.
#ifndef LICHT_PATH_UNWATCHED_GLSL
#define LICHT_PATH_UNWATCHED_GLSL
#include "path/path.glsl"

void onLight(uvec2 pixel, uint order, uint way, vec3 kept, vec3 lost) {}
void onRays(uvec2 pixel, uint order, uint rays) {}
void onFirstVertex(uvec2 pixel, Surface s, vec3 wo_local) {}
void onSecondVertex(uvec2 pixel, uint instance, float distance_) {}
void onFirstWay(uvec2 pixel, uint way, vec3 share_of_spread) {}

#endif
