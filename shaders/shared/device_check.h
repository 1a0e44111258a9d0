// What a device is asked before it draws anything: two small programs run the operations that the engine depends on, and the host knows the answers
// (engine/gpu/device_check.h).
#ifndef LICHT_SHARED_DEVICE_CHECK_H
#define LICHT_SHARED_DEVICE_CHECK_H
#include "index.h"

LICHT_SHARED_BEGIN

LICHT_CONSTANT uint kCheckGroup = 64u;  // threads of a workgroup
LICHT_CONSTANT uint kCheckGroups = 2u;
LICHT_CONSTANT uint kCheckThreads = kCheckGroups * kCheckGroup;
LICHT_CONSTANT uint kCheckRounds = 4u;

// A thread's question, read as storage, as texels of floats and as texels of words: the bits of finite floats.
struct CheckQuestion {
    uint near_one;   // 1 + thread / 2^23
    uint factor;     // 1 + (2 thread + 1) / 2^12
    uint tiny;       // (thread + 1) / 2^25
    uint beyond;     // 2^(thread - 64): of every size
};

// A thread's answers to the first program. Floats by their bits.
struct CheckAnswer {
    uint stored;           // a word of another thread's question
    uint word_texel;       // the same
    uint float_texel;      // the same
    uint sum;              // near_one + tiny
    uint product;          // factor * near_one
    uint product_less;     // factor * near_one - near_one
    uint lost;             // what rounding took from near_one + tiny
    uint finite;           // of four comparisons with infinity and with what is no finite number a bit each
    uint converted;        // words to floats and back
    uint halves;           // twice two half floats
    uint bits;             // bits counted, the highest found
    uint wrapped;          // products of words, without what overflows
    uint group_sum;        // of all threads of the workgroup, by atomics on what they share
    uint place;            // of this thread in a list that all append to
    uint distance;         // of a triangle along a ray; 0 where it is missed
};

// A thread's answers to the second program, a round.
struct BallotAnswer {
    uvec4 ballot;
    uint subgroup;    // of its workgroup
    uint lane;
    uint lanes;       // of a subgroup
    uint bits;        // of the ballot
    uint bits_below;  // this lane
    uint elected;
    uint first;       // the thread of the first lane, by broadcast
    uint place;       // in the list of the round; kNoIndex: wants none
    uint rounds;      // until all lanes of the subgroup are done
    uint reserved0;
    uint reserved1;
    uint reserved2;
};

// Whose question another thread reads: all differ.
LICHT_FUNCTION uint checkPartner(uint thread) { return (thread * 37u + 11u) % kCheckThreads; }

// Two half floats in [1, 2) and (-2, -1].
LICHT_FUNCTION uint checkHalves(uint thread) { return 0xbc003c00u + (thread << 16u) + 8u * thread; }

// Which threads want a place in a round: none, all, about half, a few.
LICHT_FUNCTION bool checkWants(uint thread, uint round) {
    if (round < 2u) return round == 1u;
    return round == 2u ? ((thread * 2654435769u) >> 31u) != 0u : thread % 7u == 3u;
}

// How many rounds a thread has work for, in a loop that its subgroup leaves together.
LICHT_FUNCTION uint checkWork(uint thread, uint round) { return checkWants(thread, round) ? (thread * 5u) % 13u : 0u; }

LICHT_SHARED_END
#endif
