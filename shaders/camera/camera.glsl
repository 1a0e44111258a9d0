// The camera, both ways: from a point on the picture to a ray, and from the world to the picture.
#ifndef LICHT_CAMERA_CAMERA_GLSL
#define LICHT_CAMERA_CAMERA_GLSL

#include "pure/sobol.glsl"
#include "shared/dimensions.h"
#include "shared/frame.h"

// Where in its pixel sample `index` lies, box filter. The rasteriser has one projection a frame, so all pixels share the offset and its noise would not
// average out over them: whatever the sampler is, the offsets fill the pixel evenly. Against multiples of two irrational numbers the error of an edge through
// the pixel is 0.7 times as large after 16 samples and 0.8 times after 256, that of a gradient 0.2 and 0.04 times.
vec2 cameraJitter(uint index, uint seed) { return uniformFromBits(sobolBits4(SampleAddress(uvec2(0xffffu), index, seed), kDimensionPixel)).xy; }

// World position relative to the eye -> clip space; w is the distance along the axis, depth is reversed: 1 at the near plane, 0 far away.
vec4 clipFromRelative(ViewRecord view, vec3 relative, vec2 jitter) {
    vec3 p = vec3(dot(view.right, relative), dot(view.up, relative), -dot(view.back, relative));
    vec2 shift = (1.0 - 2.0 * jitter) / vec2(view.size);
    if (view.orthographic != 0u)
        return vec4(p.x / view.scale_x + shift.x, -p.y / view.scale_y + shift.y, (view.z_far - p.z) / (view.z_far - view.z_near), 1.0);
    return vec4(p.x / view.scale_x + shift.x * p.z, -p.y / view.scale_y + shift.y * p.z, view.z_near, p.z);
}

// Unit direction from the scene towards the camera, for a position in pixels.
vec3 directionToCamera(ViewRecord view, vec2 pixel_position) {
    if (view.orthographic != 0u) return view.back;
    vec2 ndc = 2.0 * pixel_position / vec2(view.size) - 1.0;
    return normalize(view.back - ndc.x * view.scale_x * view.right + ndc.y * view.scale_y * view.up);
}

// The ray through a position in pixels; its direction is a unit vector.
struct CameraRay {
    vec3 origin;
    vec3 direction;
};

CameraRay cameraRay(ViewRecord view, vec2 pixel_position) {
    CameraRay ray = CameraRay(view.eye, -directionToCamera(view, pixel_position));
    if (view.orthographic != 0u) {
        vec2 ndc = 2.0 * pixel_position / vec2(view.size) - 1.0;
        ray.origin += ndc.x * view.scale_x * view.right - ndc.y * view.scale_y * view.up;
    }
    return ray;
}

vec3 directionToCamera(ViewRecord view, vec3 world_position) {
    if (view.orthographic != 0u) return view.back;
    return normalize(view.eye - world_position);
}

// Position in pixels of a world position, without jitter.
vec2 pixelFromWorld(ViewRecord view, vec3 world_position) {
    vec4 clip = clipFromRelative(view, world_position - view.eye, vec2(0.5));
    return (clip.xy / clip.w * 0.5 + 0.5) * vec2(view.size);
}

#endif
