// The watertight ray-triangle test of Woop, Benthin, Wald 2013, Watertight Ray/Triangle Intersection. Both sides count.
// The twin of engine/bvh/ray_setup.cpp and intersect_triangle.cpp: same operations in the same order, so that device and host agree bit for
// bit wherever the device's division rounds correctly.
#ifndef LICHT_PURE_INTERSECT_GLSL
#define LICHT_PURE_INTERSECT_GLSL
#include "pure/finite.glsl"
#include "shared/bvh_numerics.h"

// What a ray needs once before it meets boxes and triangles. Permuted vectors: .z is the axis along which the ray goes furthest. The direction is
// scaled by a power of two; distances in here are those of the ray times distance_scale.
// Boxes are widened by what shearing a vertex of the scene can round, so that a ray meets the box of every triangle whose edges accept it.
struct RaySetup {
    uint axis;             // the world axis that is z here
    vec3 origin;           // permuted
    vec3 shear;            // permuted; x, y: slope against z; z: 1 / direction.z
    vec2 reciprocal;       // permuted; 1 / direction, finite; of z it is shear.z
    vec2 slack;            // permuted; how much earlier and later than its planes a box is met, as a distance
    float distance_scale;  // and its reciprocal: powers of two
    float direction_scale;
};

struct TriangleHit {
    float t;
    float b1;
    float b2;
};

// Selects, because indexing by a variable is slow on drivers that keep vectors in registers.
vec3 permuted(vec3 v, uint axis) {
    return axis == 0u ? v.yzx : (axis == 1u ? v.zxy : v);
}

vec3 unpermuted(vec3 v, uint axis) {
    return axis == 0u ? v.zxy : (axis == 1u ? v.yzx : v);
}

// False: this ray hits nothing (not finite, no direction, or too far out).
bool setUpRay(vec3 origin, vec3 direction, vec3 scene_lower, vec3 scene_upper, out RaySetup ray) {
    vec3 way = abs(direction);
    ray.axis = way.x >= way.y && way.x >= way.z ? 0u : (way.y >= way.z ? 1u : 2u);
    // The power of two at or below the longest component; one below the last, whose reciprocal would be denormal.
    float longest = max(max(way.x, way.y), way.z);
    uint exponent = min(floatBitsToUint(longest) >> 23u, 253u);
    ray.distance_scale = uintBitsToFloat(exponent << 23u);
    ray.direction_scale = uintBitsToFloat((254u - exponent) << 23u);
    ray.origin = permuted(origin, ray.axis);
    vec3 d = permuted(direction * ray.direction_scale, ray.axis);
    ray.shear = vec3(d.x / d.z, d.y / d.z, 1.0F / d.z);

    vec2 direction_sign = vec2(d.x < 0.0F ? -1.0F : 1.0F, d.y < 0.0F ? -1.0F : 1.0F);
    ray.reciprocal = 1.0F / (direction_sign * max(abs(d.xy), vec2(abs(d.z) * kBvhFlattestDirection)));
    vec3 reach = max(abs(permuted(scene_lower, ray.axis) - ray.origin), abs(permuted(scene_upper, ray.axis) - ray.origin));
    precise vec2 slack = (reach.xy + reach.z) * kBvhShearSlack + abs(ray.origin.xy) * kBvhOriginSlack;
    ray.slack = slack * abs(ray.reciprocal);
    return allFinite(origin) && allFinite(direction) && all(lessThanEqual(abs(origin), vec3(kBvhLargestCoordinate))) &&
           longest >= kBvhShortestDirection;
}

// a x b. Rounding is monotonic, so a sign is right or the value is zero.
float edgeFunction(vec2 a, vec2 b) {
    precise float left = a.x * b.y;
    precise float right = a.y * b.x;
    precise float value = left - right;
    return value;
}

// A triangle as the ray sees it.
struct ShearedTriangle {
    vec2 a, b, c;   // where the vertices pass the ray
    vec3 x, y, z;   // distances along the ray to the three vertices, by each axis
};

ShearedTriangle shearTriangle(RaySetup ray, vec3 v0, vec3 v1, vec3 v2) {
    precise vec3 a = permuted(v0, ray.axis) - ray.origin;
    precise vec3 b = permuted(v1, ray.axis) - ray.origin;
    precise vec3 c = permuted(v2, ray.axis) - ray.origin;
    // Shear the ray onto the z axis.
    precise vec2 pa = a.xy - ray.shear.xy * a.z;
    precise vec2 pb = b.xy - ray.shear.xy * b.z;
    precise vec2 pc = c.xy - ray.shear.xy * c.z;
    return ShearedTriangle(pa, pb, pc, vec3(a.x, b.x, c.x) * ray.reciprocal.x, vec3(a.y, b.y, c.y) * ray.reciprocal.y,
                           vec3(a.z, b.z, c.z) * ray.shear.z);
}

// By comparisons: min() and max() pay for NaN on some drivers.
float smallest3(vec3 v) {
    float least = v.x < v.y ? v.x : v.y;
    return least < v.z ? least : v.z;
}

float largest3(vec3 v) {
    float most = v.x > v.y ? v.x : v.y;
    return most > v.z ? most : v.z;
}

// How far off the distance of a hit may be: kBvhDistanceSlack says why.
float distanceUncertainty(ShearedTriangle s, float determinant, float first, float last) {
    precise float beside = largest3(vec3(largest3(abs(vec3(s.a.x, s.b.x, s.c.x))), largest3(abs(vec3(s.a.y, s.b.y, s.c.y))), 0.0F));
    precise float away = beside + 2.0F * (abs(first) > abs(last) ? abs(first) : abs(last));
    precise float spread = last - first;
    precise float uncertain = kBvhDistanceSlack * (beside / abs(determinant) * away) * spread;
    return uncertain;
}

// An edge function that is rounded to zero counts as inside, for every triangle at that edge: what the exact sign would take from one of them, which
// Woop, Benthin and Wald look for in double precision, belongs to a neighbour, and the neighbours' common boundary stays closed. So a ray can meet a
// lone triangle by a rounding beside its edge, and never slip between two. (Of tiny triangles far aside every edge function may be rounded to zero: the
// ray must meet the triangle's box too.)
// The distance is kept inside the triangle's box as the traversal measures it; so a traversal that skips boxes beyond the nearest hit returns exactly
// what testing every triangle returns. No range is applied here, but a hit that may as well lie behind the origin, on a triangle
// that reaches there, is none.
bool testTriangle(RaySetup ray, vec3 v0, vec3 v1, vec3 v2, out TriangleHit hit) {
    ShearedTriangle s = shearTriangle(ray, v0, v1, v2);
    float u = edgeFunction(s.c, s.b);
    float v = edgeFunction(s.a, s.c);
    float w = edgeFunction(s.b, s.a);
    precise float determinant = u + v + w;
    hit.b1 = v / determinant;
    hit.b2 = w / determinant;
    precise float t = u / determinant * s.z.x + hit.b1 * s.z.y + hit.b2 * s.z.z;
    vec3 edges = vec3(u, v, w);
    bool met = determinant != 0.0F && !(smallest3(edges) < 0.0F && largest3(edges) > 0.0F);

    float first = smallest3(s.z);
    float last = largest3(s.z);
    precise float uncertain = distanceUncertainty(s, determinant, first, last);
    met = met && (first > 0.0F || t >= uncertain);

    float nearest = largest3(vec3(smallest3(s.x) - ray.slack.x, smallest3(s.y) - ray.slack.y, first));
    float farthest = smallest3(vec3(largest3(s.x) + ray.slack.x, largest3(s.y) + ray.slack.y, last));
    t = t > nearest ? t : nearest;
    hit.t = t < farthest ? t : farthest;
    return met && nearest <= farthest;
}

#endif
