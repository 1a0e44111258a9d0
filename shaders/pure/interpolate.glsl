// Linear interpolation that gives equal numbers back bit for bit, whatever the weights: what is compared with a threshold must not be off by an ulp.
#ifndef LICHT_PURE_INTERPOLATE_GLSL
#define LICHT_PURE_INTERPOLATE_GLSL

// mix() may round both of its products.
vec3 lerp(vec3 a, vec3 b, float f) { return a + f * (b - a); }
vec4 lerp(vec4 a, vec4 b, float f) { return a + f * (b - a); }

// On a triangle. weights: of its vertices, as barycentrics b: 1 - b1 - b2, b1, b2.
vec2 interpolate(vec3 weights, vec2 a, vec2 b, vec2 c) { return a + weights.y * (b - a) + weights.z * (c - a); }
vec3 interpolate(vec3 weights, vec3 a, vec3 b, vec3 c) { return a + weights.y * (b - a) + weights.z * (c - a); }
vec4 interpolate(vec3 weights, vec4 a, vec4 b, vec4 c) { return a + weights.y * (b - a) + weights.z * (c - a); }

#endif
