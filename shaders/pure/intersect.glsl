// The watertight ray-triangle test of Woop, Benthin, Wald 2013, Watertight Ray/Triangle Intersection. Both sides count.
// The twin of engine/bvh/ray_setup.cpp and intersect_triangle.cpp: same operations in the same order, so that device and host agree bit for
// bit wherever the device's division rounds correctly.
#ifndef LICHT_PURE_INTERSECT_GLSL
#define LICHT_PURE_INTERSECT_GLSL
#include "shared/bvh_numerics.h"

// What a ray needs once before it meets boxes and triangles. Vectors are permuted: .z is the axis along which the ray goes furthest.
// Boxes are widened by what shearing a vertex of the scene can round, so that a ray meets the box of every triangle whose edges accept it.
struct RaySetup {
    uint axis;         // the world axis that is z here
    bvec3 negative;    // the ray goes down this axis: its near plane is the upper one
    vec3 origin;
    vec3 shear;        // x, y: slope against z; z: 1 / direction.z
    vec3 reciprocal;   // 1 / direction, finite
    vec3 origin_near;  // origins that near and far planes are measured from
    vec3 origin_far;
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

// By the exponent bits: a compiler may assume that isnan() and isinf() are false.
bool allFinite(vec3 v) {
    return all(notEqual(floatBitsToUint(v) & 0x7f800000u, uvec3(0x7f800000u)));
}

// False: this ray hits nothing (not finite, no direction, or too far out).
bool setUpRay(vec3 origin, vec3 direction, vec3 scene_lower, vec3 scene_upper, out RaySetup ray) {
    vec3 way = abs(direction);
    ray.axis = way.x >= way.y && way.x >= way.z ? 0u : (way.y >= way.z ? 1u : 2u);
    ray.origin = permuted(origin, ray.axis);
    vec3 d = permuted(direction, ray.axis);
    ray.negative = lessThan(d, vec3(0.0F));
    ray.shear = vec3(d.x / d.z, d.y / d.z, 1.0F / d.z);

    vec3 direction_sign = vec3(ray.negative.x ? -1.0F : 1.0F, ray.negative.y ? -1.0F : 1.0F, ray.negative.z ? -1.0F : 1.0F);
    ray.reciprocal = 1.0F / (direction_sign * max(abs(d), vec3(abs(d.z) * kBvhFlattestDirection)));

    vec3 reach = max(abs(permuted(scene_lower, ray.axis) - ray.origin), abs(permuted(scene_upper, ray.axis) - ray.origin));
    precise vec2 slack = (reach.xy + reach.z) * kBvhShearSlack + abs(ray.origin.xy) * kBvhOriginSlack;
    precise vec3 to_near = direction_sign * vec3(slack, 0.0F);
    ray.origin_near = ray.origin + to_near;
    ray.origin_far = ray.origin - to_near;
    return allFinite(origin) && allFinite(direction) && all(lessThanEqual(abs(origin), vec3(kBvhLargestCoordinate))) &&
           abs(d.z) >= kBvhShortestDirection;
}

// Splits a into parts of 12 bits, so that products of parts are exact (Veltkamp 1968).
vec2 splitFloat(float a) {
    precise float c = 4097.0F * a;
    precise float high = c - (c - a);
    precise float low = a - high;
    return vec2(high, low);
}

// What rounding took from the product a * b (Dekker 1971, A Floating-Point Technique for Extending the Available Precision).
float productError(float a, float b) {
    vec2 x = splitFloat(a);
    vec2 y = splitFloat(b);
    precise float product = a * b;
    precise float error = ((x.x * y.x - product) + x.x * y.y + x.y * y.x) + x.y * y.y;
    return error;
}

// a x b where both products round to the same float: the difference of what rounding took. The largest coordinate is brought to about 2^60
// first, so that neither the splitting overflows nor the small parts underflow.
float edgeFunctionExact(vec2 a, vec2 b) {
    float largest = max(max(abs(a.x), abs(a.y)), max(abs(b.x), abs(b.y)));
    uint scale_exponent = uint(clamp(314 - int(floatBitsToUint(largest) >> 23u), 1, 253));
    float scale = uintBitsToFloat(scale_exponent << 23u);
    float unscale = uintBitsToFloat((254u - scale_exponent) << 23u);
    vec2 p = a * scale;
    vec2 q = b * scale;
    precise float difference = (p.x * q.y - p.y * q.x) + (productError(p.x, q.y) - productError(p.y, q.x));
    return difference * unscale * unscale;
}

// a x b. Rounding is monotonic, so a sign is right or the value is zero; a zero is looked at again without rounding.
float edgeFunction(vec2 a, vec2 b) {
    precise float left = a.x * b.y;
    precise float right = a.y * b.x;
    precise float value = left - right;
    return value;
}

// The distance is kept inside the triangle's own box as the traversal measures it; so a traversal that skips boxes beyond the nearest hit
// returns exactly what testing every triangle returns. No range is applied here.
bool testTriangle(RaySetup ray, vec3 v0, vec3 v1, vec3 v2, out TriangleHit hit) {
    hit = TriangleHit(0.0F, 0.0F, 0.0F);
    vec3 p0 = permuted(v0, ray.axis);
    vec3 p1 = permuted(v1, ray.axis);
    vec3 p2 = permuted(v2, ray.axis);
    precise vec3 a = p0 - ray.origin;
    precise vec3 b = p1 - ray.origin;
    precise vec3 c = p2 - ray.origin;

    // Shear the ray onto the z axis.
    precise vec2 pa = a.xy - ray.shear.xy * a.z;
    precise vec2 pb = b.xy - ray.shear.xy * b.z;
    precise vec2 pc = c.xy - ray.shear.xy * c.z;

    float u = edgeFunction(pc, pb);
    float v = edgeFunction(pa, pc);
    float w = edgeFunction(pb, pa);
    if (u == 0.0F || v == 0.0F || w == 0.0F) {
        u = u == 0.0F ? edgeFunctionExact(pc, pb) : u;
        v = v == 0.0F ? edgeFunctionExact(pa, pc) : v;
        w = w == 0.0F ? edgeFunctionExact(pb, pa) : w;
    }
    precise float determinant = u + v + w;
    if (determinant == 0.0F || (min(min(u, v), w) < 0.0F && max(max(u, v), w) > 0.0F)) {
        return false;
    }

    hit.b1 = v / determinant;
    hit.b2 = w / determinant;
    precise float t = u / determinant * (a.z * ray.shear.z) + hit.b1 * (b.z * ray.shear.z) + hit.b2 * (c.z * ray.shear.z);

    // Keep the distance inside the triangle's box.
    vec3 lower = min(min(p0, p1), p2);
    vec3 upper = max(max(p0, p1), p2);
    vec3 enter = (mix(lower, upper, ray.negative) - ray.origin_near) * ray.reciprocal;
    vec3 leave = (mix(upper, lower, ray.negative) - ray.origin_far) * ray.reciprocal;
    float nearest = max(max(enter.x, enter.y), enter.z);
    float farthest = min(min(leave.x, leave.y), leave.z);
    farthest = max(farthest * kBvhFarWider, farthest * kBvhFarNarrower);
    hit.t = min(max(t, nearest), farthest);
    return true;
}

#endif
