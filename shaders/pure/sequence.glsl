// Where the numbers of a sample come from. u.xy and u.zw are a pair each: a choice in two dimensions takes one of them whole.
#ifndef LICHT_PURE_SEQUENCE_GLSL
#define LICHT_PURE_SEQUENCE_GLSL

#include "pure/sobol.glsl"
#include "shared/choices.h"
#include "shared/constants.h"

layout(constant_id = kConstantSampler) const uint kSampler = kSamplerSobol;
layout(constant_id = kConstantBlueBits) const uint kBlueBits = 4u;

uvec4 sampleBits4(SampleAddress a, uint dimension) {
    if (kSampler == kSamplerRandom) return randomBits4(a, dimension);
    if (kSampler == kSamplerBlue) return blueBits4(a, dimension, kBlueBits);
    return sobolBits4(a, dimension);
}

vec4 sample4(SampleAddress a, uint dimension) { return uniformFromBits(sampleBits4(a, dimension)); }

#endif
