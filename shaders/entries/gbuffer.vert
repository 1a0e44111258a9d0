#version 460
#extension GL_GOOGLE_include_directive : require
// Primary hits by rasterising: every vertex is pulled by its place in the triangle list, so that triangle and corner are known without any
// optional feature, and the barycentrics are plain interpolated values.
#include "camera/camera.glsl"
#include "bound/scene.glsl"
#include "shared/constants.h"
#include "shared/frame.h"

layout(push_constant) uniform Push { SamplePush push; };

layout(location = 0) out vec2 barycentrics;
layout(location = 1) flat out uvec2 instance_primitive;

layout(constant_id = kConstantMergedInstances) const uint kMergedInstances = 0u;

// A draw of many baked instances begins with `first`; their triangles stand in a row.
uint instanceOf(uint first, uint triangle) {
    if (first >= kMergedInstances) return first;
    uint end = kMergedInstances;
    while (end - first > 1u) {
        uint middle = first + (end - first) / 2u;
        if (instanceAt(middle).first_triangle <= triangle) first = middle;
        else end = middle;
    }
    return first;
}

void main() {
    uint triangle = uint(gl_VertexIndex) / 3u;
    uint corner = uint(gl_VertexIndex) % 3u;
    uint instance = instanceOf(uint(gl_InstanceIndex), triangle);
    vec3 position = worldPoint(placementOf(instance), vertexAt(triangleIndexAt(gl_VertexIndex)).position);
    barycentrics = vec2(corner == 1u ? 1.0 : 0.0, corner == 2u ? 1.0 : 0.0);
    instance_primitive = uvec2(instance, triangle - instanceAt(instance).first_triangle);
    gl_Position = clipFromRelative(frame.view, position - frame.view.eye, cameraJitter(push.sample_index, frame.seed));
}
