// Radiance from infinitely far, stored as a latitude-longitude map, and directions drawn by it.
#ifndef LICHT_LIGHT_SKY_GLSL
#define LICHT_LIGHT_SKY_GLSL

#include "bound/scene.glsl"
#include "pure/latlong.glsl"
#include "pure/sequence.glsl"
#include "shared/bindings.h"
#include "shared/choices.h"
#include "shared/constants.h"
#include "shared/light.h"

layout(constant_id = kConstantEnvironmentSampling) const uint kEnvironmentSampling = kEnvironmentAlias;

layout(binding = kBindingEnvironmentMap) uniform sampler2D environment_map;
layout(binding = kBindingEnvironmentTable) uniform usampler2D environment_table;  // engine/light/environment_table.h

// The map may be turned about +Y: its column u is met at u - turn.
vec2 mapFromDirection(vec3 direction) {
    vec2 uv = latlongFromDirection(direction);
    uv.x += frame.environment_turn;
    return uv.x > 1.0 ? vec2(uv.x - 1.0, uv.y) : uv;
}
vec3 directionFromMap(float u, float y, float s) { return directionFromLatlong(u - frame.environment_turn, y, s); }

// Bilinear by hand: linear filtering of fp32 images is optional in Vulkan, and its weights have few bits.
vec3 environmentRadiance(vec3 direction) {
    ivec2 size = ivec2(frame.environment_size);
    vec2 x = mapFromDirection(direction) * vec2(size) - 0.5;
    ivec2 i = ivec2(floor(x));
    vec2 f = x - vec2(i);
    int left = (i.x + size.x) % size.x;
    int right = (i.x + 1) % size.x;
    int top = clamp(i.y, 0, size.y - 1);
    int bottom = clamp(i.y + 1, 0, size.y - 1);
    return lerp(lerp(texelFetch(environment_map, ivec2(left, top), 0).rgb, texelFetch(environment_map, ivec2(right, top), 0).rgb, f.x),
                lerp(texelFetch(environment_map, ivec2(left, bottom), 0).rgb, texelFetch(environment_map, ivec2(right, bottom), 0).rgb, f.x), f.y);
}

// Solid angle of one texel of that row, 2 pi / width times the difference of two cosines as a product, which loses nothing near the poles.
float texelSolidAngle(uint row) {
    uvec2 size = frame.environment_size;
    uint from_pole = min(row, size.y - 1u - row);
    return 4.0 * kPi / float(size.x) * unitCircle(0.5 * (float(from_pole) + 0.5) / float(size.y)).y * unitCircle(0.25 / float(size.y)).y;
}

// 1 - cos(theta) of the upper edge of a row, down to the equator and a little beyond.
float rowEdge(uint row) {
    float s = unitCircle(0.25 * float(row) / float(frame.environment_size.y)).y;
    return 2.0 * s * s;
}

// Uniform by solid angle within a texel; v grows downwards.
vec3 directionInTexel(uvec2 texel, float u, float v) {
    uvec2 size = frame.environment_size;
    bool south = 2u * texel.y >= size.y;
    uint row = south ? size.y - 1u - texel.y : texel.y;
    float below_pole = mix(rowEdge(row), rowEdge(row + 1u), south ? 1.0 - v : v);
    float sine = sqrt(below_pole * (2.0 - below_pole));
    return directionFromMap((float(texel.x) + u) / float(size.x), south ? below_pole - 1.0 : 1.0 - below_pole, sine);
}

uvec2 texelOf(vec3 direction) {
    uvec2 size = frame.environment_size;
    return min(uvec2(mapFromDirection(direction) * vec2(size)), size - 1u);
}

// Inversion: the share of a texel is that of its row times its own within it, both as steps between ends.
uint endOf(uvec2 texel) { return texelFetch(environment_table, ivec2(texel), 0).x; }

uint startOf(uvec2 texel, bool of_row) {
    if (of_row) return texel.y > 0u ? endOf(texel - uvec2(0u, 1u)) : 0u;
    return texel.x > 0u ? endOf(texel - uvec2(1u, 0u)) : 0u;
}

uvec2 rowEnd(uvec2 texel) { return uvec2(frame.environment_size.x, texel.y); }

float texelShare(uvec2 texel) {
    if (kEnvironmentSampling != kEnvironmentInversion) return uintBitsToFloat(texelFetch(environment_table, ivec2(texel), 0).z);
    float column = float(endOf(texel) - startOf(texel, false)), row = float(endOf(rowEnd(texel)) - startOf(rowEnd(texel), true));
    return row / float(kEnvironmentUnits) * (column / float(kEnvironmentUnits));
}

float pdfEnvironment(vec3 direction) {
    uvec2 texel = texelOf(direction);
    return texelShare(texel) / texelSolidAngle(texel.y);
}

struct EnvironmentSample {
    vec3 direction;
    float pdf;   // solid angle
    uint tries;  // that rejection took; 0: it was not asked
};

// A texel by its share, in constant time, then a direction in it.
EnvironmentSample sampleByAlias(uvec4 bits) {
    uvec2 size = frame.environment_size;
    uint i, unused;
    // 24-bit numbers could not reach every texel of a large map: the whole word picks the column.
    umulExtended(bits.x, size.x * size.y, i, unused);
    vec4 u = uniformFromBits(bits);
    uvec4 a = texelFetch(environment_table, ivec2(i % size.x, i / size.x), 0);
    if (u.y >= uintBitsToFloat(a.x)) i = a.y;
    uvec2 texel = uvec2(i % size.x, i / size.x);
    return EnvironmentSample(directionInTexel(texel, u.w, u.z), texelShare(texel) / texelSolidAngle(texel.y), 0u);
}

// How many of `count` ends from `texel` on along `step` are at most `at`; never all of them.
uint endsUpTo(uvec2 texel, uvec2 along, uint count, uint at) {
    uint passed = 0u;
    for (uint width = 1u << uint(findMSB(count)); width > 0u; width >>= 1u) {
        uint next = passed + width;
        if (next < count && endOf(texel + (next - 1u) * along) <= at) passed = next;
    }
    return passed;
}

// Where `at` lies between two ends, in [0,1); `below` is what comes after its last digit.
float placeBetween(uint start, uint end, uint at, float below) {
    return min((float(at - start) + below) / float(max(end - start, 1u)), 0.99999994);
}

// The row by the distribution function of all rows, the column by that of the row. Neighbours on the square of (x, y) stay neighbours on the map, so that
// evenly spread numbers give evenly spread directions.
EnvironmentSample sampleByInversion(uvec4 bits) {
    uvec2 at = bits.yx >> 1u;
    vec2 below = uniformFromBits(bits).zw;
    uvec2 texel = uvec2(0u);
    texel.y = endsUpTo(rowEnd(texel), uvec2(0u, 1u), frame.environment_size.y, at.y);
    texel.x = endsUpTo(texel, uvec2(1u, 0u), frame.environment_size.x, at.x);
    float v = placeBetween(startOf(rowEnd(texel), true), endOf(rowEnd(texel)), at.y, below.y);
    float u = placeBetween(startOf(texel, false), endOf(texel), at.x, below.x);
    return EnvironmentSample(directionInTexel(texel, u, v), texelShare(texel) / texelSolidAngle(texel.y), 0u);
}

// A direction uniform over the sphere, kept with a chance in proportion to its density; the mean number of tries is 4 pi times the largest density. Maps with
// a small sun take thousands of tries: after the last one the alias table answers, and because it has the same density, that of the whole is the same.
EnvironmentSample sampleByRejection(uvec4 bits) {
    for (uint i = 0u; i < kEnvironmentMostTries; ++i) {
        vec4 u = uniformFromBits(bits);
        float y = 1.0 - 2.0 * u.y;
        EnvironmentSample e;
        e.direction = directionFromLatlong(u.x, y, 2.0 * sqrt(u.y * (1.0 - u.y)));
        e.pdf = pdfEnvironment(e.direction);
        e.tries = i + 1u;
        if (u.z * frame.environment_peak < e.pdf) return e;
        bits = hash4(bits);
    }
    EnvironmentSample e = sampleByAlias(bits);
    e.tries = kEnvironmentMostTries;
    return e;
}

// All four words are used.
EnvironmentSample sampleEnvironment(uvec4 bits) {
    if (kEnvironmentSampling == kEnvironmentInversion) return sampleByInversion(bits);
    if (kEnvironmentSampling == kEnvironmentRejection) return sampleByRejection(bits);
    return sampleByAlias(bits);
}

#endif
