// Lights, the tree over them and the table that picks one.
#ifndef LICHT_SHARED_LIGHT_H
#define LICHT_SHARED_LIGHT_H
#include "index.h"

LICHT_SHARED_BEGIN

LICHT_CONSTANT uint kLightTriangle = 0u;
LICHT_CONSTANT uint kLightPoint = 1u;
LICHT_CONSTANT uint kLightSpot = 2u;
LICHT_CONSTANT uint kLightDirectional = 3u;
LICHT_CONSTANT uint kLightEnvironment = 4u;
LICHT_CONSTANT uint kLightRectangle = 5u;
LICHT_CONSTANT uint kLightSphere = 6u;  // a round mesh, by the sphere around it
LICHT_CONSTANT uint kLightKindMask = 0xffu;
LICHT_CONSTANT uint kLightDoubleSided = 0x100u;  // flags beside the kind
LICHT_CONSTANT uint kLightUneven = 0x200u;       // what it emits varies over it or by direction

// light_views.h says what the words mean for each kind.
struct LightRecord {
    vec3 a;
    uint kind;  // and flags
    vec3 b;
    float u;
    vec3 c;
    float v;
    vec3 d;
    float w;
    uint instance;  // of what is made of triangles: its hit record; of a sphere primitive 0
    uint primitive;
    float pmf;   // probability that the table picks this light, or the tree that it is in
    uint trail;  // in the tree: which child at which level, kLightTrailBits each
};
LICHT_CONSTANT uint kLightTexels = 5u;

// The light tree: four children a node. Two levels of a binary tree ask as many clusters for their importance and know less of them.
LICHT_CONSTANT uint kLightChildren = 4u;
LICHT_CONSTANT uint kLightTrailBits = 2u;

// A child, whose intensity is 0 where there is none: a bounding box, a cone of normals, and how far light reaches around them.
struct LightChildRecord {
    vec3 centre;      // world
    float intensity;  // cd, of all lights below, if all their normals were one
    vec3 half_size;
    float mean_normal;  // length of the mean of the normals, were they even over their cone
    vec3 axis;          // unit
    float cos_reach;    // of the angle to the axis within which any light leaves, at most pi
    float sin_reach;
    uint next;        // index of a node or, with kLightLeaf, of a light; flags
    float radius;     // of the sphere around the box
    float softening;  // added to the distance's square: lights of a wide cluster are not all at its centre; 0 for a point
};
LICHT_CONSTANT uint kLightChildTexels = 4u;
LICHT_CONSTANT uint kLightLeaf = 0x80000000u;
LICHT_CONSTANT uint kLightTwoSided = 0x40000000u;
LICHT_CONSTANT uint kLightIndexMask = 0x3fffffffu;
// Added to cosines, so that rounding and the packing of normals (3e-5) never hide a light that is barely seen.
LICHT_CONSTANT float kLightSlack = 1e-4F;
// Of a cluster's importance. No theory gives these four: they were tuned on one hall of 200 lamps, where the variance hardly changes around them. Whatever
// they are, picks stay unbiased; other scenes may want others.
LICHT_CONSTANT float kLightLeastReceived = 0.2F;  // of the sine of its sphere's angular radius, where the mean is less
LICHT_CONSTANT float kLightLeastEmitted = 0.1F;   // of the emission, where the mean is less
LICHT_CONSTANT float kLightSoftening = 0.4F;      // of its radius's square, in that of the distance
LICHT_CONSTANT float kLightWidening = 0.25F;      // of that sine's square, in that of a specular layer's width

// One column of an alias table (Walker 1974; Vose 1991): keep this entry when u < threshold, else take `alias`.
struct AliasRecord {
    float threshold;
    uint alias;
    float pmf;
    uint reserved;
};

LICHT_CONSTANT uint kEnvironmentUnits = 0x80000000u;  // the whole of a distribution function
LICHT_CONSTANT uint kEnvironmentMostTries = 32u;

LICHT_SHARED_END
#endif
