#version 460
#extension GL_GOOGLE_include_directive : require
// Marks the pixels beside which others show something else.
#include "history/edges.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Push { ReprojectPush push; };
layout(r32f, binding = kBindingEdgeParts) uniform writeonly image2D edge_parts;

// Instance + 1, and what is linear over a plane's picture: 1 / depth, or under an orthographic camera depth.
vec2 shownAt(ivec2 pixel, vec4 place) {
    uint instance = gbufferHit(pixel).instance;
    return instance == kNoIndex ? vec2(0.0) : vec2(float(instance + 1u), frame.view.orthographic != 0u ? place.w : 1.0 / place.w);
}

// Whether pixels beside it on opposite sides show something else, a corner or a step.
bool isEdge(ivec2 pixel) {
    const float kFacing = 0.7, kBend = 0.01;
    vec4 place = placeAt(pixel);
    vec2 here = shownAt(pixel, place);
    for (int i = 0; i < 2; ++i) {
        ivec2 offset = i == 0 ? ivec2(1, 0) : ivec2(0, 1);
        ivec2 before = max(pixel - offset, ivec2(0)), behind = min(pixel + offset, ivec2(frame.view.size) - 1);
        vec4 place_before = placeAt(before), place_behind = placeAt(behind);
        vec2 there_before = shownAt(before, place_before), there_behind = shownAt(behind, place_behind);
        if (there_before.x != here.x || there_behind.x != here.x) return true;
        if (here.x == 0.0) continue;
        if (min(dot(place_before.xyz, place.xyz), dot(place_behind.xyz, place.xyz)) < kFacing) return true;
        bool inside = before != pixel && behind != pixel;
        if (inside && abs(there_before.y + there_behind.y - 2.0 * here.y) > kBend * here.y) return true;
    }
    return false;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!isInside(pixel)) return;
    bool edge = push.fresh == 0u && isEdge(pixel);
    imageStore(edge_parts, tilePlace(imageSize(edge_parts), frame.view.size, kEdgeMark, uvec2(pixel)), vec4(edge ? 1.0 : 0.0));
}
