// Infinity, and what is finite.
#ifndef LICHT_PURE_FINITE_GLSL
#define LICHT_PURE_FINITE_GLSL

// A function, because initialisers of constants cannot call uintBitsToFloat().
float infinity() { return uintBitsToFloat(0x7f800000u); }

// By the exponent bits: a compiler may assume that isnan() and isinf() are false.
bool allFinite(vec3 v) { return all(notEqual(floatBitsToUint(v) & 0x7f800000u, uvec3(0x7f800000u))); }

#endif
