// The bounding volume hierarchy as builder and traversal see it.
#ifndef LICHT_SHARED_BVH_LAYOUT_H
#define LICHT_SHARED_BVH_LAYOUT_H
#include "seam.h"

LICHT_SHARED_BEGIN

// Up to seven children in 64 bytes (after Ylitie, Karras, Laine 2017, Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs):
// their planes are bytes q on the node's own grid, and a plane stands at origin + q * 2^(exponent - 127), rounded outwards. A slot is a node or one
// triangle. Nodes come first, sorted along `axis`; they are child_base, child_base + 1, ... in the order of their slots, and the triangles stand at
// triangle_base, triangle_base + 1, ... in the leaves' order. Four texels, because a driver that runs lanes in lockstep pays by the fetch.
struct BvhNode {
    vec3 origin;
    uint head;       // exponents of x, y, z: a byte each; kBvhNodeCountShift, kBvhCountShift, kBvhAxisShift
    uvec4 planes_x;  // bytes: lower planes of slots 0 to 6, a byte of child_base; upper planes of slots 0 to 6, a byte of triangle_base
    uvec4 planes_y;  // the same with the second bytes
    uvec4 planes_z;  // and the third
};

LICHT_CONSTANT uint kBvhWidth = 7u;
LICHT_CONSTANT uint kBvhTexelsPerNode = 4u;
LICHT_CONSTANT uint kBvhTexelsPerTriangle = 3u;  // v0, v1, v2; in w, as numbers: the input triangle, its instance, its number in that
// A position of an instance holds the rows of the matrix to its object and the pivot's coordinates; a texel behind all positions has the root of its
// mesh and its number.
LICHT_CONSTANT uint kBvhInstanceFrame = 4u;    // entries of the stack that hold where the world was left
LICHT_CONSTANT uint kBvhNodeCountShift = 24u;  // three bits: slots that are nodes
LICHT_CONSTANT uint kBvhCountShift = 27u;      // three bits: slots in use
LICHT_CONSTANT uint kBvhAxisShift = 30u;       // two bits: 0 to 2
LICHT_CONSTANT uint kBvhLastPlane = 255u;
LICHT_CONSTANT uint kBvhNone = 0xffffffffu;
// Node and triangle indices are 24 bits: what three bytes hold beside the planes, and what a float holds exactly.
LICHT_CONSTANT uint kBvhMostTriangles = 0x1000000u;

LICHT_SHARED_END
#endif
