#version 460
#extension GL_GOOGLE_include_directive : require
// Marks the pixels beside which others show something else.
#include "history/edges.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Push { ReprojectPush push; };
layout(r32f, binding = kBindingEdgeParts) uniform writeonly image2D edge_parts;

// Whether one of the four pixels beside shows something else.
bool isEdge(ivec2 pixel, Hit hit) {
    vec3 position = vec3(0.0), normal = vec3(0.0);
    if (hit.instance != kNoIndex) {
        position = hitPosition(hit);
        normal = placeAt(pixel).xyz;
    }
    for (int i = 0; i < 4; ++i) {
        ivec2 tap = pixel + (i < 2 ? ivec2(2 * i - 1, 0) : ivec2(0, 2 * i - 5));
        if (isInside(tap) && !isOf(tap, hit.instance, position, normal)) return true;
    }
    return false;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!isInside(pixel)) return;
    bool edge = push.fresh == 0u && isEdge(pixel, gbufferHit(pixel));
    imageStore(edge_parts, tilePlace(imageSize(edge_parts), frame.view.size, kEdgeMark, uvec2(pixel)), vec4(edge ? 1.0 : 0.0));
}
