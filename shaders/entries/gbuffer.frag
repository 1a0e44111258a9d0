#version 460
#extension GL_GOOGLE_include_directive : require
// Stores the hit record; partly transparent surfaces are there or not, as for every other ray.
#include "bound/surface.glsl"
#include "shared/frame.h"
#include "shared/geometry.h"

layout(push_constant) uniform Push { SamplePush push; };

layout(location = 0) in vec2 barycentrics;
layout(location = 1) flat in uvec2 instance_primitive;
layout(location = 0) out uvec4 hit_record;

// Along the camera's axis.
float fragmentDepth() {
    ViewRecord view = frame.view;
    return view.orthographic != 0u ? view.z_far - gl_FragCoord.z * (view.z_far - view.z_near) : 1.0 / gl_FragCoord.w;
}

void main() {
    if (fragmentDepth() > frame.view.z_limit) discard;
    // Interpolation may end a rounding outside the triangle.
    vec2 b = max(barycentrics, vec2(0.0));
    float sum = b.x + b.y;
    if (sum > 1.0) b /= sum;
    if (kAlpha && (instanceAt(instance_primitive.x).flags & kInstanceAlpha) != 0u) {
        SampleAddress address = SampleAddress(uvec2(gl_FragCoord.xy), push.sample_index, frame.seed);
        uint triangle = instanceAt(instance_primitive.x).first_triangle + instance_primitive.y;
        if (!passesAlphaTest(instance_primitive.x, instance_primitive.y, b.x, b.y, coverageNumber(address, 0u, instance_primitive.x, triangle))) discard;
    }
    hit_record = uvec4(instance_primitive, floatBitsToUint(b));
}
