// Which pixels a frame samples, and which of their samples it draws: all of them and the frame's own, unless tiles are sampled as their noise calls for.
#ifndef LICHT_PATH_ADAPTIVE_GLSL
#define LICHT_PATH_ADAPTIVE_GLSL
#include "shared/bindings.h"
#include "shared/constants.h"
#include "shared/frame.h"

layout(constant_id = kConstantAdaptive) const bool kAdaptive = false;
layout(std430, binding = kBindingAdaptiveTiles) readonly buffer AdaptiveTiles { AdaptiveTileRecord adaptive_tiles[]; };

AdaptiveTileRecord adaptiveTile(uvec2 pixel, uint width) {
    uvec2 tile = pixel / kAdaptiveTileSide;
    return adaptive_tiles[tile.y * ((width + kAdaptiveTileSide - 1u) / kAdaptiveTileSide) + tile.x];
}

// width: of the picture; frame_index: of the frame's samples.
bool isSampled(uvec2 pixel, uint width, uint frame_index) { return !kAdaptive || frame_index < adaptiveTile(pixel, width).end; }

// A pixel's samples are numbered without gaps, whichever frames draw them.
uint sampleIndexOf(uvec2 pixel, uint width, uint frame_index) { return kAdaptive ? frame_index - adaptiveTile(pixel, width).behind : frame_index; }

#endif
