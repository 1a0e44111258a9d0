// Which numbers a pixel's sample draws.
#ifndef LICHT_PATH_ADDRESS_GLSL
#define LICHT_PATH_ADDRESS_GLSL
#include "path/adaptive.glsl"
#include "path/path.glsl"

const uint kSeedOfSecondHalf = 0x9e3779b9u;  // golden ratio: far from seeds that people type

SampleAddress sampleAddress(uvec2 pixel, uint frame_index) {
    SampleAddress address = SampleAddress(pixel, sampleIndexOf(pixel, frame.view.size.x, frame_index), frame.seed);
    if (!kSignals) return address;
    // Two sequences in turn, so that the halves of a pixel's samples are independent.
    address.seed ^= (address.index & 1u) * kSeedOfSecondHalf;
    address.index >>= 1u;
    return address;
}

#endif
