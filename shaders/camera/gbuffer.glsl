// The G-buffer as the passes behind it read it.
#ifndef LICHT_CAMERA_GBUFFER_GLSL
#define LICHT_CAMERA_GBUFFER_GLSL

#include "camera/camera.glsl"
#include "bound/scene.glsl"
#include "shared/bindings.h"
#include "shared/index.h"

layout(rgba32ui, binding = kBindingGbuffer) uniform readonly uimage2D gbuffer;

Hit gbufferHit(ivec2 pixel) {
    uvec4 record = imageLoad(gbuffer, pixel);
    return record.x == kNoIndex ? kNoHit : Hit(record.x, record.y, uintBitsToFloat(record.z), uintBitsToFloat(record.w));
}

vec3 hitPosition(Hit hit) {
    uvec3 v = triangleVertices(hit.instance, hit.primitive);
    Placement at = placementOf(hit.instance);
    return (1.0 - hit.b1 - hit.b2) * worldPoint(at, vertexAt(v.x).position) + hit.b1 * worldPoint(at, vertexAt(v.y).position) +
           hit.b2 * worldPoint(at, vertexAt(v.z).position);
}

// Through the pixel, where its sample lies.
CameraRay pixelRay(ivec2 pixel, uint sample_index) { return cameraRay(frame.view, vec2(pixel) + cameraJitter(sample_index, frame.seed)); }

// Unit direction from what the pixel's sample saw to the camera.
vec3 gbufferWo(Hit hit, ivec2 pixel, uint sample_index) {
    if (hit.instance == kNoIndex) return -pixelRay(pixel, sample_index).direction;
    return directionToCamera(frame.view, hitPosition(hit));
}

#endif
