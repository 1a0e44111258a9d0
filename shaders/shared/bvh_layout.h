// The bounding volume hierarchy as builder and traversal see it.
#ifndef LICHT_SHARED_BVH_LAYOUT_H
#define LICHT_SHARED_BVH_LAYOUT_H
#include "seam.h"

LICHT_SHARED_BEGIN

// Four children; per axis one texel of the four lower and one of the four upper planes, so that a traversal fetches near and far planes by
// the sign of the direction. An unused child has lower = +inf, upper = -inf and kBvhNoChild.
struct BvhNode {
    vec4 lower_x;
    vec4 upper_x;
    vec4 lower_y;
    vec4 upper_y;
    vec4 lower_z;
    vec4 upper_z;
    uvec4 child;  // kBvhLeaf | count << kBvhCountShift | first position in the leaves' order, or the index of a node
};

LICHT_CONSTANT uint kBvhTexelsPerNode = 7u;
LICHT_CONSTANT uint kBvhTexelsPerTriangle = 3u;  // v0, v1, v2; w unused
LICHT_CONSTANT uint kBvhLeaf = 0x80000000u;
LICHT_CONSTANT uint kBvhCountShift = 28u;        // three bits: a leaf holds 1 to kBvhMaxLeaf triangles
LICHT_CONSTANT uint kBvhMaxLeaf = 4u;
LICHT_CONSTANT uint kBvhFirstMask = 0x0fffffffu;
LICHT_CONSTANT uint kBvhNoChild = 0xffffffffu;

LICHT_SHARED_END
#endif
