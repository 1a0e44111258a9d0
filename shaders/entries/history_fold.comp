#version 460
#extension GL_GOOGLE_include_directive : require
// Before the view changes: what it has told, with what the ones before it had, becomes the history; and what tells the surfaces of its pixels apart.
#include "filter/halves.glsl"

layout(rgba32f, binding = kBindingHistory) uniform writeonly image2D history;

// So many samples of a half outlive a change of view. More would take less noise away than what is drawn a little beside its place, from frame to frame,
// brings wrong light.
const float kMostSamples = 16.0;

void store(uint tile, ivec2 pixel, vec4 value) { imageStore(history, tilePlace(imageSize(history), push.size, tile, uvec2(pixel)), value); }

// What tells surfaces apart at a pixel: instance + 1, and 1 / depth, which is linear over a plane's picture, or under an orthographic camera depth.
vec2 shownAt(ivec2 pixel) {
    vec4 surface = tileTexel(signal_sums, kSumSurface, pixel);
    float hits = tileTexel(signal_sums, kSumFirstSpread, pixel).a, depth = tileTexel(signal_sums, kSumFirstPlace, pixel).w;
    if (surface.y <= 0.0 || hits <= 0.0) return vec2(0.0);
    return vec2(surface.x, push.orthographic != 0u ? depth / hits : hits / depth);
}

// Whether the pixels around show the same surface without a step or a corner: then taps may reach over it.
bool isSmooth(ivec2 pixel) {
    const float kBend = 0.01;
    vec2 here = shownAt(pixel);
    if (here.x <= 0.0) return false;
    for (int i = 0; i < 4; ++i) {
        ivec2 offset = i < 3 ? ivec2(i - 1, 1) : ivec2(1, 0);
        if (!isInside(pixel + offset) || !isInside(pixel - offset)) return false;
        vec2 before = shownAt(pixel - offset), behind = shownAt(pixel + offset);
        if (before.x != here.x || behind.x != here.x || abs(before.y + behind.y - 2.0 * here.y) > kBend * here.y) return false;
    }
    return true;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!isInside(pixel)) return;
    vec4 surface = tileTexel(signal_sums, kSumSurface, pixel);
    vec4 place = tileTexel(signal_sums, kSumFirstPlace, pixel);
    float hits = tileTexel(signal_sums, kSumFirstSpread, pixel).a;
    // Light of several surfaces is no history of any.
    bool one = surface.y > 0.0 && hits > 0.0;
    float n2 = dot(place.xyz, place.xyz);
    store(kHistoryPlace, pixel, one ? vec4(n2 > 0.0 ? place.xyz * inversesqrt(n2) : vec3(0.0), place.w / hits) : vec4(0.0));
    store(kHistorySurface, pixel, vec4(surface.x, isSmooth(pixel) ? 1.0 : 0.0, surface.z, surface.w));
    for (uint kind = 0u; kind < kKinds; ++kind) {
        Halves h = halvesOf(kind, demodulation(kind, pixel), pixel);
        uint tile = kPriorSpread + kHalves * kind;
        store(tile, pixel, one ? vec4(h.a, min(h.n_a, kMostSamples)) : vec4(0.0));
        store(tile + 1u, pixel, one ? vec4(h.b, min(h.n_b, kMostSamples)) : vec4(0.0));
    }
}
