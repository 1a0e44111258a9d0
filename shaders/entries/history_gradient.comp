#version 460
#extension GL_GOOGLE_include_directive : require
// How far the light changed since the view before: of each square of pixels one draws its last sample again, by the same numbers and seen by the same eye, in
// the scene as it is now. Where nothing changed it finds the same light.
// Schied, Peters, Dachsbacher 2018, Gradient Estimation for Real-Time Adaptive Temporal Filtering.
#include "camera/gbuffer.glsl"
#include "path/address.glsl"
#include "path/unwatched.glsl"
#include "shared/signals.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Push { GradientPush push; };
layout(rgba32f, binding = kBindingRadiance) uniform readonly image2D radiance_image;
layout(rgba32f, binding = kBindingGradientsTo) uniform writeonly image2D gradients_to;

float meanOf(vec3 c) { return (c.r + c.g + c.b) / 3.0; }

vec3 radianceNow(uvec2 pixel, Hit hit) {
    PathCounts counts = kNothingCounted;
    Path p = beginPath(sampleAddress(pixel, push.sample_index), hit, directionToCamera(frame.previous_view, hitPosition(hit)));
    while (p.alive) {
        if (p.hit.instance == kNoIndex) endInSky(p);
        else extendAndTrace(p, counts);
    }
    return p.radiance;
}

void main() {
    uvec2 square = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(square, uvec2(imageSize(gradients_to))))) return;
    // Another pixel each time: 7 and 25 have no common factor, so all have their turn.
    uint turn = (7u * push.sample_index + 3u * square.x + 11u * square.y) % (kGradientSide * kGradientSide);
    uvec2 pixel = min(kGradientSide * square + uvec2(turn % kGradientSide, turn / kGradientSide), frame.view.size - 1u);
    Hit hit = gbufferHit(ivec2(pixel));
    vec4 gradient = vec4(0.0);
    if (hit.instance != kNoIndex) {
        float before = meanOf(imageLoad(radiance_image, ivec2(pixel)).rgb), now = meanOf(radianceNow(pixel, hit));
        float change = now - before;
        // Relative, so that a rare bright path weighs no more than another; a path that found nothing twice says nothing.
        float share = change / max(before, now);
        if (share == share && abs(share) <= 1.0) gradient = vec4(share, share * share, 1.0, 0.0);
    }
    imageStore(gradients_to, ivec2(square), gradient);
}
