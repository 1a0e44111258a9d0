// Vertices and instances as the device has them.
// std430 rules: a vec3 is followed by a scalar, so that both languages agree on every offset without padding that nobody named.
#ifndef LICHT_SHARED_GEOMETRY_H
#define LICHT_SHARED_GEOMETRY_H
#include "index.h"

LICHT_SHARED_BEGIN

// A vertex, in world space unless its mesh is instanced: then in object space, seen from the mesh's centre. TEXCOORD_0 rides along; further sets,
// tangents and colours have buffers of their own, present only when called for.
struct VertexRecord {
    vec3 position;
    float u;
    vec3 normal;  // unit; zero: shade flat
    float v;
};

LICHT_CONSTANT uint kInstanceDoubleSided = 1u;
LICHT_CONSTANT uint kInstanceAlpha = 2u;
LICHT_CONSTANT uint kInstanceTangents = 4u;

struct InstanceRecord {
    uint first_triangle;  // into the triangle indices
    uint material;
    uint first_light;  // light index of primitive 0; kNoIndex: its triangles are not in the light table
    uint flags;
};

// Where an instance of a mesh stands: world = (dot(world_x, object), ...) + pivot. The way back is with the BVH, for rays alone.
struct InstanceTransformRecord {
    vec3 world_x;
    float pivot_x;
    vec3 world_y;
    float pivot_y;
    vec3 world_z;
    float pivot_z;
    float condition;  // how much rounding grows on the way to the object: the product of both matrices' largest row sums of magnitudes
    uint mirrored;    // 1: the transform turns fronts into backs
    uint reserved0;
    uint reserved1;
};

LICHT_SHARED_END
#endif
