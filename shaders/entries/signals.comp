#version 460
#extension GL_GOOGLE_include_directive : require
// Sums over samples of what filters work on, in two halves.
#include "pure/tiles.glsl"
#include "shared/bindings.h"
#include "shared/constants.h"
#include "shared/effects.h"
#include "shared/frame.h"
#include "shared/index.h"
#include "shared/signals.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = kEffectGlossy) const bool kGlossy = true;
layout(constant_id = kConstantReprojects) const bool kReprojects = false;
layout(push_constant) uniform Push { SamplePush push; };
layout(std430, binding = kBindingFrame) readonly buffer FrameBlock { FrameRecord frame; };
layout(rgba32f, binding = kBindingRadiance) uniform readonly image2D radiance_image;
layout(rgba32ui, binding = kBindingGbuffer) uniform readonly uimage2D gbuffer;
layout(rgba32f, binding = kBindingSampleSignals) uniform readonly image2D sample_signals;
layout(rgba32f, binding = kBindingSignalSums) uniform image2D signal_sums;

vec4 sampled(uvec2 pixel, uint tile) { return imageLoad(sample_signals, tilePlace(imageSize(sample_signals), frame.view.size, tile, pixel)); }

void add(uvec2 pixel, uint tile, vec4 value, bool fresh) {
    ivec2 at = tilePlace(imageSize(signal_sums), frame.view.size, tile, pixel);
    imageStore(signal_sums, at, value + mix(imageLoad(signal_sums, at), vec4(0.0), bvec4(fresh)));  // selected, not branched on: see accumulate.comp
}

// Where there is no light its share may be anything.
vec3 partOf(vec3 share, vec3 light) { return mix(vec3(0.0), share * light, notEqual(light, vec3(0.0))); }

// What the pixel shows, and whether it is one thing alone.
void noteSurface(uvec2 pixel, bool fresh) {
    uint instance = imageLoad(gbuffer, ivec2(pixel)).x;
    float surface = instance == kNoIndex ? 0.0 : float(instance + 1u);
    ivec2 at = tilePlace(imageSize(signal_sums), frame.view.size, kSumSurface, pixel);
    vec4 before = imageLoad(signal_sums, at);
    float alone = fresh || (before.y > 0.0 && before.x == surface) ? 1.0 : 0.0;
    // A path that mirrors nothing says nothing of what is mirrored.
    vec4 onward = kGlossy ? sampled(pixel, kShareOnward) : vec4(1.0, 1.0, 1.0, 0.0);
    bool mirrors = dot(onward.rgb, vec3(1.0)) < 1.5;
    imageStore(signal_sums, at, vec4(surface, alone, mirrors ? vec2(onward.a, sampled(pixel, kShareToLight).a) : vec2(0.0)));
}

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, frame.view.size))) return;
    vec3 seen = sampled(pixel, kSampleSeen).rgb, spread = imageLoad(radiance_image, ivec2(pixel)).rgb - seen, mirrored = vec3(0.0);
    if (kGlossy) {
        vec3 to_light = sampled(pixel, kSampleToLight).rgb, onward = spread - to_light;
        spread = partOf(sampled(pixel, kShareToLight).rgb, to_light) + partOf(sampled(pixel, kShareOnward).rgb, onward);
        mirrored = to_light + onward - spread;
    }
    uint half_ = push.sample_index % kHalves;
    bool fresh_half = push.count_before < kHalves, fresh = push.count_before == 0u;
    add(pixel, kSumSpread + half_, vec4(spread, 0.0), fresh_half);
    if (kGlossy) add(pixel, kSumMirrored + half_, vec4(mirrored, 0.0), fresh_half);
    add(pixel, kSumSeen + half_, vec4(seen, 0.0), fresh_half);
    vec4 first_spread = sampled(pixel, kFirstSpread);
    bvec4 none = bvec4(first_spread.a == 0.0);
    add(pixel, kSumFirstSpread, first_spread, fresh);
    if (kGlossy) add(pixel, kSumFirstMirrored, mix(sampled(pixel, kFirstMirrored), vec4(0.0), none), fresh);
    add(pixel, kSumFirstPlace, mix(sampled(pixel, kFirstPlace), vec4(0.0), none), fresh);
    if (kReprojects) noteSurface(pixel, fresh);
}
