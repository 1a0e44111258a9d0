// What filters work on, of one sample of each pixel: the light that the surface before the camera sent on by the lobes that spread it evenly and by those that
// mirror it, and that surface. A pixel is written by the one path that is followed for it.
#ifndef LICHT_PATH_SIGNALS_GLSL
#define LICHT_PATH_SIGNALS_GLSL
#include "path/path.glsl"
#include "path/store.glsl"
#include "pure/tiles.glsl"
#include "shared/bindings.h"
#include "shared/frame.h"
#include "shared/signals.h"

layout(rgba32f, binding = kBindingSampleSignals) uniform image2D sample_signals;

ivec2 signalPlace(uvec2 pixel, uint tile) { return tilePlace(imageSize(sample_signals), frame.view.size, tile, pixel); }

void setSignal(uvec2 pixel, uint tile, vec4 value) { imageStore(sample_signals, signalPlace(pixel, tile), value); }

// Before a path begins: nothing has been found, no surface met.
void beginSignals(uvec2 pixel) {
    if (!kSignals) return;
    setSignal(pixel, kSampleSeen, vec4(0.0));
    setSignal(pixel, kSampleToLight, vec4(0.0));
    setSignal(pixel, kFirstSpread, vec4(0.0));  // and the other tiles of a first vertex are not to be read
    if (!kReprojects || !kGlossy) return;
    setSignal(pixel, kShareOnward, vec4(1.0, 1.0, 1.0, 0.0));
    setSignal(pixel, kShareToLight, vec4(0.0));
}

void noteFirstVertex(uvec2 pixel, Surface s, vec3 wo_local) {
    Demodulation d = demodulationOf(s.bsdf, wo_local);
    setSignal(pixel, kFirstSpread, vec4(d.spread, 1.0));
    if (kGlossy) setSignal(pixel, kFirstMirrored, vec4(d.mirrored, s.bsdf.specular.alpha));
    setSignal(pixel, kFirstPlace, vec4(s.frame.normal, -dot(frame.view.back, s.position - frame.view.eye)));
}

// Until a path meets a second surface it goes on for ever.
void noteFirstWay(uvec2 pixel, uint way, vec3 share_of_spread) {
    setSignal(pixel, way == kWayToLight ? kShareToLight : kShareOnward, vec4(share_of_spread, way == kWayToLight ? 0.0 : kFarthestOnward));
}

// What the path met behind its first vertex, and how far from there.
void noteSecondVertex(uvec2 pixel, uint instance, float distance_) {
    ivec2 onward = signalPlace(pixel, kShareOnward), to_light = signalPlace(pixel, kShareToLight);
    imageStore(sample_signals, onward, vec4(imageLoad(sample_signals, onward).rgb, distance_));
    imageStore(sample_signals, to_light, vec4(imageLoad(sample_signals, to_light).rgb, float(instance + 1u)));
}

// Light of one order; a path finds it once straight away and once by its first ray to a light.
void noteSignal(uvec2 pixel, uint order, uint way, vec3 light) {
    if (order == 0u) setSignal(pixel, kSampleSeen, vec4(light, 0.0));
    else if (way == kWayToLight) setSignal(pixel, kSampleToLight, vec4(light, 0.0));
}

#endif
