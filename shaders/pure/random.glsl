// Samples are addressed, not drawn: four uniform numbers are a pure function of (pixel, sample, dimension, seed).
#ifndef LICHT_PURE_RANDOM_GLSL
#define LICHT_PURE_RANDOM_GLSL

// Jarzynski and Olano 2020, Hash Functions for GPU Rendering (JCGT 9(3)): pcg4d.
uvec4 hash4(uvec4 v) {
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    v ^= v >> 16u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return v;
}

// The upper 24 bits, so that the result is exact in fp32 and stays below one.
vec4 uniformFromBits(uvec4 bits) { return vec4(bits >> 8u) * 5.9604644775390625e-8; }

struct SampleAddress {
    uvec2 pixel;
    uint index;
    uint seed;
};

// Sides of a picture stay below 2^16, so one word names the pixel.
uint pixelWord(SampleAddress a) { return a.pixel.x | (a.pixel.y << 16u); }

// Independent numbers; sequences that fill the square evenly are in sobol.glsl.
uvec4 randomBits4(SampleAddress a, uint dimension) { return hash4(uvec4(pixelWord(a), a.index, dimension, a.seed)); }

vec4 random4(SampleAddress a, uint dimension) { return uniformFromBits(randomBits4(a, dimension)); }

#endif
