#version 460
#extension GL_GOOGLE_include_directive : require
// Brings the history to a new view: each pixel finds where in the view before lay what it shows now.
#include "history/reproject.glsl"
#include "shared/bindings.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = kEffectGlossy) const bool kGlossy = true;
layout(push_constant) uniform Push { ReprojectPush push; };
layout(rgba32f, binding = kBindingSampleSignals) uniform readonly image2D sample_signals;
layout(rgba32f, binding = kBindingGradientsFrom) uniform readonly image2D gradients_from;
layout(rgba32f, binding = kBindingPrior) uniform writeonly image2D prior;

struct Told {
    vec4 a;  // RGB: light, A: of so many samples
    vec4 b;
};

vec4 sampled(ivec2 pixel, uint tile) { return imageLoad(sample_signals, tilePlace(imageSize(sample_signals), frame.view.size, tile, uvec2(pixel))); }

void store(uint kind, ivec2 pixel, Told told) {
    uint tile = kPriorSpread + kHalves * kind;
    imageStore(prior, tilePlace(imageSize(prior), frame.view.size, tile, uvec2(pixel)), told.a);
    imageStore(prior, tilePlace(imageSize(prior), frame.view.size, tile + 1u, uvec2(pixel)), told.b);
}

// What share of the light around a pixel of the view before has changed; 0 where that may as well be noise.
float changeAround(vec2 place) {
    if (!kSceneMoves || push.changed == 0u) return 0.0;
    ivec2 square = clamp(ivec2(place) / int(kGradientSide), ivec2(0), imageSize(gradients_from) - 1);
    vec4 gradient = imageLoad(gradients_from, square);
    const float kStandardErrors = 2.0;
    return gradient.x * gradient.x > kStandardErrors * kStandardErrors * gradient.y ? min(abs(gradient.x) / gradient.z, 1.0) : 0.0;
}

// Old light that is wrong by a share r of itself counts as so many of n samples: by n r^2 over a sample's own squared error, which the filter takes to about a
// hundredth of the light's square. Less than a quarter of a sample is none: it might be of any size.
float countAfterChange(float n, float share) {
    float left = n / (1.0 + 100.0 * n * share * share);
    return left < 0.25 ? 0.0 : left;
}

// Of a cubic through four texels in a row (Catmull, Rom 1974): between them nothing is blurred, however often it is resampled.
vec4 cubicWeights(float f) {
    float g = 1.0 - f;
    return vec4(-0.5 * f * g * g, 1.0 + f * f * (1.5 * f - 2.5), 1.0 + g * g * (1.5 * g - 2.5), -0.5 * g * f * f);
}

// Light of half as many samples counts half. count: what the samples of all taps are divided by.
Told told(vec4 a, vec4 b, float count, vec2 place) {
    float n_a = max(a.a, 0.0) / max(count, 1e-6), n_b = max(b.a, 0.0) / max(count, 1e-6);
    if (kSceneMoves) {
        float share = changeAround(place);
        n_a = countAfterChange(n_a, share);
        n_b = countAfterChange(n_b, share);
    }
    return Told(vec4(a.rgb / max(a.a, 1e-6), n_a), vec4(b.rgb / max(b.a, 1e-6), n_b));
}

void addTap(uint tile, ivec2 tap, float w, inout vec4 a, inout vec4 b) {
    vec4 t_a = historyAt(tile, tap), t_b = historyAt(tile + 1u, tap);
    a += w * vec4(t_a.a * t_a.rgb, t_a.a);
    b += w * vec4(t_b.a * t_b.rgb, t_b.a);
}

Told toldAround(uint kind, Wanted wanted, vec2 place) {
    uint tile = kPriorSpread + kHalves * kind;
    ivec2 first = ivec2(floor(place - 0.5));
    vec2 f = place - 0.5 - vec2(first);
    vec4 a = vec4(0.0), b = vec4(0.0), weights = vec4(0.0);
    bool smooth_ = true;
    for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        vec2 rows = mix(1.0 - f, f, equal(offset, ivec2(1)));
        if (showsSurface(wanted, first + offset, smooth_)) weights[i] = rows.x * rows.y;
        else smooth_ = false;
    }
    if (!smooth_) {
        for (int i = 0; i < 4; ++i)
            if (weights[i] > 0.0) addTap(tile, first + ivec2(i & 1, i >> 1), weights[i], a, b);
        return told(a, b, weights.x + weights.y + weights.z + weights.w, place);
    }
    vec4 across = cubicWeights(f.x), down = cubicWeights(f.y);
    for (int i = 0; i < 16; ++i) addTap(tile, first + ivec2(i & 3, i >> 2) - 1, across[i & 3] * down[i >> 2], a, b);
    return told(a, b, 1.0, place);
}

// Where in the view before, in pixels, the point was; the middle of the pixel beside it has moved as far, whatever the jitter.
vec2 placeBefore(vec3 position, vec2 jitter) { return pixelFromWorld(frame.previous_view, position) - jitter + 0.5; }

// Mean curvature of what the pixel shows, 1/m, from the normals of the pixels beside it that show the same.
float curvatureAt(ivec2 pixel, Hit hit, vec3 position, vec3 normal) {
    float sum = 0.0, count = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 tap = pixel + (i < 2 ? ivec2(2 * i - 1, 0) : ivec2(0, 2 * i - 5));
        if (any(lessThan(tap, ivec2(0))) || any(greaterThanEqual(tap, ivec2(frame.view.size))) || gbufferHit(tap).instance != hit.instance) continue;
        vec4 there = sampled(tap, kFirstPlace);
        vec3 way = positionIn(frame.view, tap, there.w) - position;
        sum += dot(there.xyz - normal, way) / max(dot(way, way), 1e-30);
        count += 1.0;
    }
    return count > 0.0 ? sum / count : 0.0;
}

// What a mirror shows is looked for where its image was; what a lobe spreads wider the more where the surface was.
Told toldOfMirrored(ivec2 pixel, Hit hit, Wanted wanted, vec2 jitter) {
    float likeness = mirrorLikeness(sampled(pixel, kFirstMirrored).a), onward = sampled(pixel, kShareOnward).a;
    vec3 away = wanted.position - frame.view.eye, direction = frame.view.orthographic != 0u ? -frame.view.back : normalize(away);
    float image = distanceOfImage(likeness * onward, curvatureAt(pixel, hit, wanted.position, wanted.normal), -dot(direction, wanted.normal));
    const float kSharp = 0.8;
    if (likeness > kSharp) wanted.mirrored = vec2(onward, sampled(pixel, kShareToLight).a);
    return toldAround(1u, wanted, placeBefore(wanted.position + max(image, 0.0) * direction, jitter));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(frame.view.size)))) return;
    Told spread = Told(vec4(0.0), vec4(0.0)), mirrored = spread;
    Hit hit = gbufferHit(pixel);
    if (push.fresh == 0u && hit.instance != kNoIndex) {
        vec2 jitter = cameraJitter(push.sample_index, frame.seed);
        vec3 position = previousPosition(hit);
        float depth = depthIn(frame.previous_view, position);
        if (depth > 0.0) {
            const float kOffPlane = 0.01;  // of the distance
            Wanted wanted = Wanted(position, sampled(pixel, kFirstPlace).xyz, float(hit.instance + 1u), kOffPlane * depth, vec2(0.0));
            spread = toldAround(0u, wanted, placeBefore(position, jitter));
            if (kGlossy) mirrored = toldOfMirrored(pixel, hit, wanted, jitter);
        }
    }
    store(0u, pixel, spread);
    if (kGlossy) store(1u, pixel, mirrored);
}
