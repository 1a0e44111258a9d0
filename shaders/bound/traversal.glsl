// Follows a ray through the 4-wide tree of shared/bvh_layout.h. The twin of engine/bvh/traverse.cpp.
// The including shader defines, before it includes this file,
//     bool acceptHit(uint position, float t)
// which says whether a triangle that the ray meets counts there (alpha, culling). `position` is in the leaves' order.
#ifndef LICHT_BOUND_TRAVERSAL_GLSL
#define LICHT_BOUND_TRAVERSAL_GLSL
#include "pure/intersect.glsl"
#include "shared/bvh_layout.h"
#include "shared/records.h"

// Texel buffers are about twice as fast where lanes fetch one by one, but some devices keep them small; then the same data is read as storage.
layout(constant_id = 64) const bool kBvhInStorage = false;
// Bvh::max_stack: no traversal of that tree holds more entries.
layout(constant_id = 65) const uint kBvhStackSize = 64u;

layout(binding = 40) uniform samplerBuffer bvh_nodes;       // RGBA32F
layout(binding = 41) uniform usamplerBuffer bvh_children;   // the same buffer as RGBA32UI
layout(binding = 42) uniform samplerBuffer bvh_triangles;   // RGBA32F: three vertices a triangle, in the leaves' order
layout(binding = 43, std430) readonly buffer bvh_nodes_storage { vec4 bvh_node_texels[]; };
layout(binding = 44, std430) readonly buffer bvh_children_storage { uvec4 bvh_child_texels[]; };  // the same buffer
layout(binding = 45, std430) readonly buffer bvh_triangle_ids { uint bvh_triangle_id[]; };        // Bvh::triangle_ids
layout(binding = 46, std430) readonly buffer bvh_triangles_storage { vec4 bvh_triangle_texels[]; };

// True once a walk of this invocation was cut short: the lavapipe of Mesa 22.3 lets all loops of an invocation together run 65,535 rounds and
// then leaves them without a word. A round is one node or one triangle, so only huge stacks of overlapping triangles get there. Entry shaders
// report it; a picture in which it happened is wrong.
bool bvh_walk_cut = false;

struct TraceHit {
    uint position;  // in the leaves' order; kNoIndex: nothing was hit
    float t;
    float b1;       // barycentric weights of the second and third vertex
    float b2;
};

vec4 bvhNodeTexel(uint index) {
    return kBvhInStorage ? bvh_node_texels[index] : texelFetch(bvh_nodes, int(index));
}

uvec4 bvhNodeChildren(uint node) {
    uint index = node * kBvhTexelsPerNode + 6u;
    return kBvhInStorage ? bvh_child_texels[index] : texelFetch(bvh_children, int(index));
}

vec3 bvhVertex(uint index) {
    return kBvhInStorage ? bvh_triangle_texels[index].xyz : texelFetch(bvh_triangles, int(index)).xyz;
}

// Index of the input triangle, which decides between equal distances.
uint bvhTriangleOrder(uint position) {
    return bvh_triangle_id[position];
}

float bvhSmallest(vec4 v) { return min(min(v.x, v.y), min(v.z, v.w)); }
float bvhLargest(vec4 v) { return max(max(v.x, v.y), max(v.z, v.w)); }

// Entries of the children's order: the distance at which the ray enters a box, and the box's child.
void orderChildren(inout float distance_a, inout uint child_a, inout float distance_b, inout uint child_b) {
    bool exchange = distance_b < distance_a;
    float nearer = exchange ? distance_b : distance_a;
    uint nearer_child = exchange ? child_b : child_a;
    distance_b = exchange ? distance_a : distance_b;
    child_b = exchange ? child_a : child_b;
    distance_a = nearer;
    child_a = nearer_child;
}

// The children whose boxes the ray meets in [t_min, t_max], nearest first; kBvhNoChild fills the rest.
uvec4 childrenMet(RaySetup ray, uvec3 near_plane, uint node, float t_min, float t_max) {
    uint first = node * kBvhTexelsPerNode;
    vec4 enter_x = (bvhNodeTexel(first + near_plane.x) - ray.origin_near.x) * ray.reciprocal.x;
    vec4 enter_y = (bvhNodeTexel(first + near_plane.y) - ray.origin_near.y) * ray.reciprocal.y;
    vec4 enter_z = (bvhNodeTexel(first + near_plane.z) - ray.origin_near.z) * ray.reciprocal.z;
    vec4 leave_x = (bvhNodeTexel(first + (near_plane.x ^ 1u)) - ray.origin_far.x) * ray.reciprocal.x;
    vec4 leave_y = (bvhNodeTexel(first + (near_plane.y ^ 1u)) - ray.origin_far.y) * ray.reciprocal.y;
    vec4 leave_z = (bvhNodeTexel(first + (near_plane.z ^ 1u)) - ray.origin_far.z) * ray.reciprocal.z;
    vec4 nearest = max(max(enter_x, enter_y), max(enter_z, vec4(t_min)));
    vec4 farthest = min(min(leave_x, leave_y), leave_z);
    farthest = min(max(farthest * kBvhFarWider, farthest * kBvhFarNarrower), vec4(t_max));

    bvec4 met = lessThanEqual(nearest, farthest);
    vec4 key = mix(vec4(uintBitsToFloat(0x7f800000u)), nearest, met);
    uvec4 child = bvhNodeChildren(node);
    child = uvec4(met.x ? child.x : kBvhNoChild, met.y ? child.y : kBvhNoChild, met.z ? child.z : kBvhNoChild,
                  met.w ? child.w : kBvhNoChild);
    orderChildren(key.x, child.x, key.y, child.y);
    orderChildren(key.z, child.z, key.w, child.w);
    orderChildren(key.x, child.x, key.z, child.z);
    orderChildren(key.y, child.y, key.w, child.w);
    orderChildren(key.y, child.y, key.z, child.z);
    return child;
}

// The nearest hit in [t_min, t_max), or with any_hit the first one found. Equal distances go to the lower triangle index.
// A ray that is not finite or has no direction hits nothing.
TraceHit traceRay(vec3 origin, vec3 direction, float t_min, float t_max, bool any_hit) {
    TraceHit best = TraceHit(kNoIndex, t_max, 0.0F, 0.0F);
    vec3 scene_lower = vec3(bvhSmallest(bvhNodeTexel(0u)), bvhSmallest(bvhNodeTexel(2u)), bvhSmallest(bvhNodeTexel(4u)));
    vec3 scene_upper = vec3(bvhLargest(bvhNodeTexel(1u)), bvhLargest(bvhNodeTexel(3u)), bvhLargest(bvhNodeTexel(5u)));
    RaySetup ray;
    bool walking = setUpRay(origin, direction, scene_lower, scene_upper, ray);
    walking = walking && t_min < t_max && max(floatBitsToUint(t_min) << 1u, floatBitsToUint(t_max) << 1u) <= 0xff000000u;  // no NaN
    uvec3 near_plane = (uvec3(ray.axis + 1u, ray.axis + 2u, ray.axis) % 3u) * 2u + uvec3(ray.negative);

    uint stack[kBvhStackSize];
    uint stacked = 0u;
    uint current = walking ? 0u : kBvhNoChild;
    while (walking) {
        uint next = kBvhNoChild;
        if ((current & kBvhLeaf) == 0u) {
            uvec4 met = childrenMet(ray, near_plane, current, t_min, best.t);
            if (met.w != kBvhNoChild) {
                stack[stacked++] = met.w;
            }
            if (met.z != kBvhNoChild) {
                stack[stacked++] = met.z;
            }
            if (met.y != kBvhNoChild) {
                stack[stacked++] = met.y;
            }
            next = met.x;
        } else {
            uint position = current & kBvhFirstMask;
            uint count = (current & ~kBvhLeaf) >> kBvhCountShift;
            uint vertex = position * kBvhTexelsPerTriangle;
            TriangleHit hit;
            if (testTriangle(ray, bvhVertex(vertex), bvhVertex(vertex + 1u), bvhVertex(vertex + 2u), hit) && hit.t >= t_min &&
                hit.t <= best.t) {
                bool nearer = hit.t < best.t;
                if (hit.t == best.t && best.position != kNoIndex) {
                    nearer = bvhTriangleOrder(position) < bvhTriangleOrder(best.position);
                }
                if (nearer && acceptHit(position, hit.t)) {
                    best = TraceHit(position, hit.t, hit.b1, hit.b2);
                }
            }
            bool enough = any_hit && best.position != kNoIndex;
            stacked = enough ? 0u : stacked;
            // The rest of the leaf: one triangle fewer, one position on.
            next = enough || count == 1u ? kBvhNoChild : current - (1u << kBvhCountShift) + 1u;
        }
        if (next == kBvhNoChild) {
            walking = stacked > 0u;
            if (walking) {
                next = stack[--stacked];
            }
        }
        current = next;
    }
    bvh_walk_cut = bvh_walk_cut || current != kBvhNoChild;
    return best;
}

#endif
