// Four uniform numbers of every sample, as two pairs (x, y) and (z, w). The first 2^k samples of a pixel put exactly one point of a pair into each
// of the 2^k equal boxes of every shape a x b, with a and b powers of two: Sobol's first two dimensions are such a (0,2)-sequence, and nested
// scrambling keeps them one. Every pair of every dimension is shuffled and scrambled by seeds of its own, so that there are as many as one likes.
// Sobol' 1967, On the Distribution of Points in a Cube; Owen 1995, Randomly Permuted (t,m,s)-Nets and (t,s)-Sequences;
// Burley 2020, Practical Hash-based Owen Scrambling (JCGT 9(4)).
#ifndef LICHT_PURE_SOBOL_GLSL
#define LICHT_PURE_SOBOL_GLSL

#include "pure/random.glsl"

// Nested scrambling of words whose most significant digit is the lowest bit: each bit is flipped or not, as the bits below it decide. Laine and Karras
// 2011, Stratified Sampling for Stochastic Transparency; the steps are Vegdahl's (2021, Building a Better LK Hash).
uvec4 scrambleUpwards(uvec4 v, uvec4 seed) {
    v ^= v * 0x3d20adeau;
    v += seed;
    v *= (seed >> 16u) | 1u;
    v ^= v * 0x05526c56u;
    v ^= v * 0x53a22864u;
    return v;
}

uvec2 scrambleUpwards(uvec2 v, uvec2 seed) { return scrambleUpwards(v.xyxy, seed.xyxy).xy; }

// Sobol's second dimension, digits upwards: digit i is the parity of those bits j of the index for which binomial(j, i) is odd, that is (Lucas), for which
// i is a subset of j. One step for each bit of their numbers.
uvec2 secondDimension(uvec2 index) {
    index ^= index >> 16u;
    index ^= (index & 0xff00ff00u) >> 8u;
    index ^= (index & 0xf0f0f0f0u) >> 4u;
    index ^= (index & 0xccccccccu) >> 2u;
    index ^= (index & 0xaaaaaaaau) >> 1u;
    return index;
}

// Two points: `reversed` holds the bits of two shuffled indices, reversed.
uvec4 scrambledPairs(uvec2 reversed, uvec4 seeds) {
    uvec2 index = bitfieldReverse(reversed);
    uvec2 second = secondDimension(index);
    return bitfieldReverse(scrambleUpwards(uvec4(index.x, second.x, index.y, second.y), seeds));
}

// Seeds of the two shuffles are words x and y of a hash, those of the scrambling are made of z and w: shuffled apart, the pairs share nothing that
// equal scrambling could show.
uvec4 scrambleSeeds(uvec4 hash) { return hash.zwzw ^ uvec4(0u, 0u, 0x9e3779b9u, 0x85ebca6bu); }

uvec4 sobolBits4(SampleAddress a, uint dimension) {
    uvec4 hash = hash4(uvec4(pixelWord(a), 0u, dimension, a.seed));
    return scrambledPairs(scrambleUpwards(uvec2(bitfieldReverse(a.index)), hash.xy), scrambleSeeds(hash));
}

// Bits of x and y in turn, x lowest. Sides of a picture stay below 2^16.
uint mortonCode(uvec2 p) {
    p = (p | (p << 8u)) & 0x00ff00ffu;
    p = (p | (p << 4u)) & 0x0f0f0f0fu;
    p = (p | (p << 2u)) & 0x33333333u;
    p = (p | (p << 1u)) & 0x55555555u;
    return p.x | (p.y << 1u);
}

// One sequence for all pixels, in the order of a tree over the picture: each block of pixels, large or small, holds a stretch of the sequence, so that
// their errors cancel and what is left is noise of high frequencies. Ahmed and Wonka 2020, Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling
// Error via Hierarchical Ordering of Pixels. A pixel takes 2^block_bits points in a row; its next block of samples is of another sequence, and so are tiles
// of pixels further apart than 32 bits can number.
uvec4 blueBits4(SampleAddress a, uint dimension, uint block_bits) {
    uint morton = mortonCode(a.pixel);
    uint tile = block_bits > 0u ? morton >> (32u - block_bits) : 0u;
    uint reversed = bitfieldReverse((morton << block_bits) | (a.index & ((1u << block_bits) - 1u)));
    uvec4 hash = hash4(uvec4(tile, a.index >> block_bits, dimension, a.seed));
    // Scrambling the place in the sequence swaps halves of blocks. (Drawing which two quarters of a square are a half as well was measured: no bluer.)
    uvec2 order = scrambleUpwards(uvec2(reversed), hash.xy);
    return scrambledPairs(order, scrambleSeeds(hash));
}

#endif
