// Radiance from infinitely far, stored as a latitude-longitude map.
#ifndef LICHT_BOUND_ENVIRONMENT_GLSL
#define LICHT_BOUND_ENVIRONMENT_GLSL

#include "bound/scene.glsl"
#include "pure/latlong.glsl"
#include "pure/random.glsl"

layout(binding = 8) uniform sampler2D environment_map;
layout(std430, binding = 7) readonly buffer EnvironmentAlias { AliasRecord environment_alias[]; };

// Bilinear by hand: linear filtering of fp32 images is optional in Vulkan, and its weights have few bits.
vec3 environmentRadiance(vec3 direction) {
    ivec2 size = ivec2(frame.environment_size);
    vec2 x = latlongFromDirection(direction) * vec2(size) - 0.5;
    ivec2 i = ivec2(floor(x));
    vec2 f = x - vec2(i);
    int left = (i.x + size.x) % size.x;
    int right = (i.x + 1) % size.x;
    int top = clamp(i.y, 0, size.y - 1);
    int bottom = clamp(i.y + 1, 0, size.y - 1);
    return mix(mix(texelFetch(environment_map, ivec2(left, top), 0).rgb, texelFetch(environment_map, ivec2(right, top), 0).rgb, f.x),
               mix(texelFetch(environment_map, ivec2(left, bottom), 0).rgb, texelFetch(environment_map, ivec2(right, bottom), 0).rgb, f.x), f.y);
}

// cos(theta) of the upper edge of a row, without sin or cos of an arbitrary angle.
float rowEdge(uint row) {
    return row == 0u ? 1.0 : row == frame.environment_size.y ? -1.0 : unitCircle(0.5 * float(row) / float(frame.environment_size.y)).x;
}

// Solid angle of one texel of that row.
float texelSolidAngle(uint row) { return 2.0 * kPi / float(frame.environment_size.x) * (rowEdge(row) - rowEdge(row + 1u)); }

struct EnvironmentSample {
    vec3 direction;
    float pdf;  // solid angle
};

// A texel by its share of the power, then a direction uniform in its solid angle.
EnvironmentSample sampleEnvironment(uvec4 bits) {
    uint texel, unused;
    // 24-bit numbers could not reach every texel of a large map: the whole word picks the column.
    umulExtended(bits.x, frame.environment_size.x * frame.environment_size.y, texel, unused);
    vec4 u = uniformFromBits(bits);
    AliasRecord a = environment_alias[texel];
    if (u.y >= a.threshold) {
        texel = a.alias;
        a = environment_alias[texel];
    }
    uvec2 at = uvec2(texel % frame.environment_size.x, texel / frame.environment_size.x);
    float y = mix(rowEdge(at.y + 1u), rowEdge(at.y), u.z);
    float longitude = (float(at.x) + u.w) / float(frame.environment_size.x);
    return EnvironmentSample(directionFromLatlong(longitude, y), a.pmf / texelSolidAngle(at.y));
}

float pdfEnvironment(vec3 direction) {
    uvec2 size = frame.environment_size;
    vec2 uv = latlongFromDirection(direction);
    uvec2 at = min(uvec2(uv * vec2(size)), size - 1u);
    return environment_alias[at.y * size.x + at.x].pmf / texelSolidAngle(at.y);
}

#endif
