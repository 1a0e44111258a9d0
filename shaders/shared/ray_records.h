// Rays and hits in lists, for measuring: recorded by one program, traced by another.
#ifndef LICHT_SHARED_RAY_RECORDS_H
#define LICHT_SHARED_RAY_RECORDS_H
#include "seam.h"

LICHT_SHARED_BEGIN

// t_max < t_min: there is no ray in this place.
struct RayRecord {
    vec3 origin;
    float t_min;
    vec3 direction;
    float t_max;
};

struct RayHitRecord {
    uint triangle;  // in the order of the scene's flattened geometry; kNoIndex: nothing; kRayTruncated: the traversal was truncated
    float t;
    float b1;  // barycentric weights of the second and third vertex
    float b2;
};

LICHT_CONSTANT uint kRayTruncated = 0xfffffffeu;

// The lists that the recording program fills, one ray a pixel each.
LICHT_CONSTANT uint kRaysPrimary = 0u;
LICHT_CONSTANT uint kRaysFirstShadow = 1u;  // from the first hit to a sampled light
LICHT_CONSTANT uint kRaysFirstBounce = 2u;  // scattered at the first hit
LICHT_CONSTANT uint kRaysSecondShadow = 3u;
LICHT_CONSTANT uint kRaysSecondBounce = 4u;
LICHT_CONSTANT uint kRaysGlossy = 5u;  // leaving the first hit by a GGX lobe of kRecordedRoughness
LICHT_CONSTANT uint kRayLists = 6u;
LICHT_CONSTANT uint kRecordedBounces = 2u;

LICHT_CONSTANT float kRecordedRoughness = 0.2F;  // glTF's: the lobe's alpha is its square

// Which rays of a list a submission traces.
struct RayRange {
    uint first;
    uint count;
};

LICHT_SHARED_END
#endif
