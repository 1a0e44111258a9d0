#version 460
#extension GL_GOOGLE_include_directive : require
// Before the view changes: what it has told, with what the ones before it had, becomes the history; and what tells the surfaces of its pixels apart.
#include "filter/halves.glsl"

layout(rgba32f, binding = kBindingHistory) uniform writeonly image2D history;

// So many samples of a half outlive a change of view. More would take less noise away than what is drawn a little beside its place, from frame to frame,
// brings wrong light.
const float kMostSamples = 16.0;

void store(uint tile, ivec2 pixel, vec4 value) { imageStore(history, tilePlace(imageSize(history), push.size, tile, uvec2(pixel)), value); }

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
    store(kHistorySurface, pixel, vec4(surface.x, 0.0, surface.z, surface.w));
    for (uint kind = 0u; kind < kKinds; ++kind) {
        Halves h = halvesOf(kind, demodulation(kind, pixel), pixel);
        uint tile = kPriorSpread + kHalves * kind;
        store(tile, pixel, one ? vec4(h.a, min(h.n_a, kMostSamples)) : vec4(0.0));
        store(tile + 1u, pixel, one ? vec4(h.b, min(h.n_b, kMostSamples)) : vec4(0.0));
    }
}
