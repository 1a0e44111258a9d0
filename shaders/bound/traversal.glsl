// Follows a ray through the wide tree of shared/bvh_layout.h. The twin of engine/bvh/traverse.cpp.
// The including shader defines, before it includes this file,
//     bool acceptHit(uint position, float t)
// which says whether a triangle that the ray meets counts there (alpha, culling). `position` is in the leaves' order.
#ifndef LICHT_BOUND_TRAVERSAL_GLSL
#define LICHT_BOUND_TRAVERSAL_GLSL
#include "bound/instance_effect.glsl"
#include "pure/intersect.glsl"
#include "shared/bvh_layout.h"
#include "shared/bindings.h"
#include "shared/constants.h"
#include "shared/effects.h"
#include "shared/index.h"

// Texel buffers are about twice as fast where lanes fetch one by one, but some devices keep them small; then the same data is read as storage.
layout(constant_id = kConstantBvhInStorage) const bool kBvhInStorage = false;
// Bvh::max_stack: no traversal of that tree holds more entries.
layout(constant_id = kConstantBvhStackSize) const uint kBvhStackSize = 64u;
// kConstantRaysPerThread; more than one: lanes are refilled (ray_list.glsl), as suits devices that run them in lockstep.
layout(constant_id = kConstantRaysPerThread) const uint kRaysPerThread = 1u;
layout(constant_id = kEffectLightSpheres) const bool kLightSpheres = false;
const bool kRefilled = kRaysPerThread > 1u;

// Positions from here on are instances.
layout(constant_id = kConstantFirstInstancePosition) const uint kFirstInstancePosition = 0xffffffffu;
// TwoLevelBvh::slack
layout(constant_id = kConstantInstanceSlack) const float kSlackOfInstances = 0.0;
// Added to an instance's position it gives the texel with its root and number.
layout(constant_id = kConstantFirstInstanceTexel) const uint kFirstInstanceTexel = 0u;

layout(binding = kBindingBvhNodes) uniform usamplerBuffer bvh_nodes;     // RGBA32UI
layout(binding = kBindingBvhTriangles) uniform samplerBuffer bvh_triangles;  // RGBA32F: three vertices a triangle, in the leaves' order
layout(binding = kBindingBvhNodesStorage, std430) readonly buffer bvh_nodes_storage { uvec4 bvh_node_texels[]; };
layout(binding = kBindingBvhTrianglesStorage, std430) readonly buffer bvh_triangles_storage { vec4 bvh_triangle_texels[]; };

// True once a walk of this invocation was cut short: the lavapipe of Mesa 22.3 lets all loops of an invocation together run 65,535 rounds and
// then leaves them without a word. A round is one node and one triangle, so only huge stacks of overlapping triangles get there. Entry shaders
// report it; a picture in which it happened is wrong.
bool bvh_walk_cut = false;

// Where any hit is asked for, one nearer than this ends the walk; of those behind it the nearest is wanted. Read only where round meshes are sampled as
// one light.
float bvh_any_before = uintBitsToFloat(0x7f800000u);

// The instance whose object space the ray is in; kNoIndex: the world, and baked triangles.
uint bvh_instance = kNoIndex;
uint bvhInstance() { return bvh_instance; }

struct TraceHit {
    uint position;  // in the leaves' order; kNoIndex: nothing was hit
    uint instance;  // bvh_instance
    float t;
    float b1;       // barycentric weights of the second and third vertex
    float b2;
};

const TraceHit kNoTraceHit = TraceHit(kNoIndex, kNoIndex, 0.0, 0.0, 0.0);

uvec4 bvhNodeTexel(uint index) { return kBvhInStorage ? bvh_node_texels[index] : texelFetch(bvh_nodes, int(index)); }

vec4 bvhTriangleTexel(uint index) { return kBvhInStorage ? bvh_triangle_texels[index] : texelFetch(bvh_triangles, int(index)); }

// Index of the input triangle, which decides between equal distances.
uint bvhTriangleOrder(uint position) { return uint(bvhTriangleTexel(position * kBvhTexelsPerTriangle).w); }

// 2^(exponent - 127) of the three bytes of a node's head.
vec3 gridStep(uint head) { return uintBitsToFloat(uvec3(head << 23u, head << 15u, head << 7u) & 0x7f800000u); }

// Number of the lowest bit set, by the exponent of a float: drivers without a vector instruction for it do this faster than findLSB().
uint lowestBit(uint bits) { return (floatBitsToUint(float(int(bits & (0u - bits)))) >> 23u) - 127u; }

// A ray among boxes. Distances as in RaySetup.
struct BoxRay {
    vec3 origin;      // world
    vec3 reciprocal;  // world; 1 / direction
    vec3 slack;       // world; how much earlier and later than its planes a box is met
};

BoxRay boxRay(vec3 origin, RaySetup ray) {
    return BoxRay(origin, unpermuted(vec3(ray.reciprocal, ray.shear.z), ray.axis), unpermuted(vec3(ray.slack, 0.0F), ray.axis));
}

// What a ray meets in a node.
struct NodeHits {
    uint nodes;          // bits of slots that are nodes
    uint triangles;      // bits of slots that are triangles, the first of them at bit 0
    uint nearest;        // slot of the nearest node
    uint child_base;
    uint triangle_base;
    bool reversed;       // the ray meets the slots from the last to the first
};

// Distances are compared as integers: among numbers that are not negative the order is the same, one below zero is below all of them, and which of
// several below zero it is does not matter, as t_min is not negative. That saves the drivers' care for NaN.
// quantised: a plane's byte where it stands in the word, so the word's place is in `scale`.
ivec3 planeDistances(vec3 quantised, vec3 scale, vec3 offset) { return floatBitsToInt(quantised * scale + offset); }

void meetChild(uint slot, uvec3 near_words, uvec3 far_words, uint mask, uint shift, vec3 scale, vec3 offset_near, vec3 offset_far, int t_min, int t_max,
               uint node_count, inout uint met, inout int nearest) {
    ivec3 enter = planeDistances(vec3(ivec3((near_words >> shift) & mask)), scale, offset_near);
    ivec3 leave = planeDistances(vec3(ivec3((far_words >> shift) & mask)), scale, offset_far);
    int first = max(max(enter.x, enter.y), max(enter.z, t_min));
    int last = min(min(leave.x, leave.y), min(leave.z, t_max));
    bool hit = first <= last;
    met |= hit ? 1u << slot : 0u;
    // The slot rides in the lowest bits of its distance.
    nearest = min(nearest, hit && slot < node_count ? int((uint(first) & ~7u) | slot) : 0x7fffffff);
}

NodeHits meetNode(BoxRay ray, uint node, float t_min, float t_max) {
    uint first = node * kBvhTexelsPerNode;
    uvec4 head = bvhNodeTexel(first);
    uvec4 x = bvhNodeTexel(first + 1u);
    uvec4 y = bvhNodeTexel(first + 2u);
    uvec4 z = bvhNodeTexel(first + 3u);

    NodeHits hits;
    uint node_count = (head.w >> kBvhNodeCountShift) & 7u;
    uint count = (head.w >> kBvhCountShift) & 7u;
    uint axis = head.w >> kBvhAxisShift;
    hits.child_base = (x.y >> 24u) | ((y.y >> 16u) & 0xff00u) | ((z.y >> 8u) & 0xff0000u);
    hits.triangle_base = (x.w >> 24u) | ((y.w >> 16u) & 0xff00u) | ((z.w >> 8u) & 0xff0000u);
    bvec3 negative = lessThan(ray.reciprocal, vec3(0.0F));
    hits.reversed = axis == 0u ? negative.x : (axis == 1u ? negative.y : negative.z);

    // A plane is met at q A + B; kBvhPlaneSlack says why B is moved.
    vec3 scale = ray.reciprocal * gridStep(head.w);
    vec3 offset = (uintBitsToFloat(head.xyz) - ray.origin) * ray.reciprocal;
    vec3 slack = ray.slack + kBvhPlaneSlack * (abs(offset) + float(kBvhLastPlane) * abs(scale));
    vec3 offset_near = offset - slack;
    vec3 offset_far = offset + slack;
    // The bytes stay where they are in their words; the last one would be negative there.
    vec3 scale_1 = scale * (1.0F / 256.0F);
    vec3 scale_2 = scale * (1.0F / 65536.0F);

    uvec4 near_far_x = negative.x ? x.zwxy : x;
    uvec4 near_far_y = negative.y ? y.zwxy : y;
    uvec4 near_far_z = negative.z ? z.zwxy : z;
    uvec3 near_0 = uvec3(near_far_x.x, near_far_y.x, near_far_z.x);
    uvec3 near_1 = uvec3(near_far_x.y, near_far_y.y, near_far_z.y);
    uvec3 far_0 = uvec3(near_far_x.z, near_far_y.z, near_far_z.z);
    uvec3 far_1 = uvec3(near_far_x.w, near_far_y.w, near_far_z.w);

    int earliest = floatBitsToInt(t_min), latest = floatBitsToInt(t_max);
    uint met = 0u;
    int nearest = 0x7fffffff;
    meetChild(0u, near_0, far_0, 0xffu, 0u, scale, offset_near, offset_far, earliest, latest, node_count, met, nearest);
    meetChild(1u, near_0, far_0, 0xff00u, 0u, scale_1, offset_near, offset_far, earliest, latest, node_count, met, nearest);
    meetChild(2u, near_0, far_0, 0xff0000u, 0u, scale_2, offset_near, offset_far, earliest, latest, node_count, met, nearest);
    meetChild(3u, near_0, far_0, 0xffu, 24u, scale, offset_near, offset_far, earliest, latest, node_count, met, nearest);
    meetChild(4u, near_1, far_1, 0xffu, 0u, scale, offset_near, offset_far, earliest, latest, node_count, met, nearest);
    meetChild(5u, near_1, far_1, 0xff00u, 0u, scale_1, offset_near, offset_far, earliest, latest, node_count, met, nearest);
    meetChild(6u, near_1, far_1, 0xff0000u, 0u, scale_2, offset_near, offset_far, earliest, latest, node_count, met, nearest);
    met &= (1u << count) - 1u;
    hits.nodes = met & ((1u << node_count) - 1u);
    hits.triangles = met >> node_count;
    hits.nearest = uint(nearest) & 7u;
    return hits;
}

// Entries that wait are groups: a base index in the upper 24 bits, below it kGroupReversed and a bit for each member. Members of a reversed group
// stand in reverse, so that the lowest bit is always the next.
const uint kGroupBits = 127u;
const uint kGroupReversed = 128u;

uint makeGroup(uint base, uint members, bool reversed) {
    return (base << 8u) | (reversed ? kGroupReversed | (bitfieldReverse(members) >> (32u - kBvhWidth)) : members);
}

uint firstOfGroup(uint group) {
    uint bit = lowestBit(group & kGroupBits);
    return (group >> 8u) + ((group & kGroupReversed) != 0u ? kBvhWidth - 1u - bit : bit);
}

uint withoutFirst(uint group) { return group & (group - 1u); }

// Takes the hit if it is nearer than the best, or as near and of a lower triangle.
void offerHit(uint position, float triangle, TriangleHit hit, RaySetup ray, float t_min, inout TraceHit best, inout float best_triangle) {
    bool before = kInstances && bvh_instance != best.instance ? bvh_instance + 1u < best.instance + 1u : triangle < best_triangle;
    bool nearer = hit.t < best.t || (hit.t == best.t && before);
    if (hit.t >= t_min && nearer && acceptHit(position, hit.t * ray.direction_scale)) {
        best = TraceHit(position, bvh_instance, hit.t, hit.b1, hit.b2);
        best_triangle = triangle;
    }
}

// The box of a tree.
void treeBounds(uint root, out vec3 lower, out vec3 upper) {
    uvec4 head = bvhNodeTexel(root * kBvhTexelsPerNode);
    lower = uintBitsToFloat(head.xyz);
    precise vec3 end = lower + float(kBvhLastPlane) * gridStep(head.w);
    upper = end;
}

// In the world, boxes are met earlier and later by what going to an object's space can move the ray.
BoxRay widenedForInstances(BoxRay boxes, vec3 lower, vec3 upper) {
    vec3 reach = max(abs(lower - boxes.origin), abs(upper - boxes.origin));
    float moved = kSlackOfInstances * max(max(reach.x, reach.y), reach.z);
    boxes.slack += (moved + abs(boxes.origin) * kBvhOriginSlack) * abs(boxes.reciprocal);
    return boxes;
}

// A ray on its way through the tree, between two rounds. What waits is in bvh_stack.
struct Walk {
    vec3 origin;         // world
    vec3 direction;
    float t_first;       // t_min as it was asked for
    float t_min;         // scaled as `ray` is
    RaySetup ray;        // in the space of bvh_instance, as all below
    BoxRay boxes;
    TraceHit best;
    float best_triangle;
    uint current;        // the node to meet next
    uint waiting;        // the group on top of the stack
    // Triangles to test: two groups, so that a lane may go on to the next node while one is left; both are tested one triangle a round.
    uint triangles;
    uint more_triangles;
    uint stacked;
    uint base;           // entries below belong to the world, which the ray has left for an object
};

uint bvh_stack[kBvhStackSize + 1u];  // one more, because kRefilled writes behind the last entry

bool walks(Walk w) { return w.current != kBvhNone || w.triangles != 0u || (kInstances && bvh_instance != kNoIndex); }

// scene_lower, scene_upper: treeBounds(0).
void startWalk(out Walk w, vec3 origin, vec3 direction, float t_min, float t_max, vec3 scene_lower, vec3 scene_upper) {
    w.origin = origin;
    w.direction = direction;
    bool fine = setUpRay(origin, direction, scene_lower, scene_upper, w.ray);
    fine = fine && t_min < t_max && max(floatBitsToUint(t_min) << 1u, floatBitsToUint(t_max) << 1u) <= 0xff000000u;  // no NaN
    w.t_first = t_min;
    w.t_min = t_min > 0.0F ? t_min * w.ray.distance_scale : 0.0F;
    w.boxes = boxRay(origin, w.ray);
    if (kInstances) w.boxes = widenedForInstances(w.boxes, scene_lower, scene_upper);
    bvh_instance = kNoIndex;
    w.best = TraceHit(kNoIndex, kNoIndex, t_max * w.ray.distance_scale, 0.0F, 0.0F);
    w.best_triangle = -1.0F;  // nothing comes before a range's end
    w.current = fine ? 0u : kBvhNone;
    w.waiting = 0u;
    w.triangles = 0u;
    w.more_triangles = 0u;
    w.stacked = 0u;
    w.base = 0u;
}

// What was hit, with its distance along the ray as it was asked for. The walk has ended.
TraceHit hitOfWalk(Walk w) {
    w.best.t *= w.ray.direction_scale;
    return w.best;
}

// Returns whether the group that waited before waits below a new one.
bool stepNode(inout Walk w) {
    NodeHits hits = meetNode(w.boxes, w.current, w.t_min, w.best.t);
    uint found = hits.triangles != 0u ? makeGroup(hits.triangle_base, hits.triangles, false) : 0u;
    w.more_triangles = w.triangles != 0u ? found : 0u;
    w.triangles = w.triangles != 0u ? w.triangles : found;

    // On to the nearest child while its siblings wait, or to the next that waits.
    uint siblings = hits.nodes & ~(1u << hits.nearest);
    bool below = siblings != 0u && w.waiting != 0u;
    if (siblings != 0u) w.waiting = makeGroup(hits.child_base, siblings, hits.reversed);
    if (hits.nodes != 0u) {
        w.current = hits.child_base + hits.nearest;
    } else {
        w.current = w.waiting != 0u ? firstOfGroup(w.waiting) : kBvhNone;
        w.waiting = w.waiting != 0u ? withoutFirst(w.waiting) : 0u;
        if (w.waiting != 0u && (w.waiting & kGroupBits) == 0u) {
            w.waiting = 0u;
            if (w.stacked > w.base) w.waiting = bvh_stack[--w.stacked];
        }
    }
    return below;
}

// Returns the position of the instance to enter in this round, or kBvhNone.
uint stepTriangle(inout Walk w, bool any_hit) {
    uint position = firstOfGroup(w.triangles);
    w.triangles = withoutFirst(w.triangles);
    bool left = (w.triangles & kGroupBits) != 0u;
    w.triangles = left ? w.triangles : w.more_triangles;
    w.more_triangles = left ? w.more_triangles : 0u;

    uint texel = position * kBvhTexelsPerTriangle;
    vec4 v0 = bvhTriangleTexel(texel);
    TriangleHit hit;
    bool met = testTriangle(w.ray, v0.xyz, bvhTriangleTexel(texel + 1u).xyz, bvhTriangleTexel(texel + 2u).xyz, hit);
    bool is_instance = kInstances && position >= kFirstInstancePosition;
    if (met && !is_instance) offerHit(position, v0.w, hit, w.ray, w.t_min, w.best, w.best_triangle);
    bool enough = any_hit && w.best.position != kNoIndex && (!kLightSpheres || w.best.t < bvh_any_before * w.ray.distance_scale);
    w.triangles = enough ? 0u : w.triangles;
    w.more_triangles = enough ? 0u : w.more_triangles;
    w.current = enough ? kBvhNone : w.current;
    if (kInstances && enough) bvh_instance = kNoIndex;
    return is_instance ? position : kBvhNone;
}

// Into an instance, or back from one. In the round and not outside of it (as a loop that lanes leave and enter again): 10 % faster on lavapipe, where
// lanes would wait for each other. best.t stays the same place.
void stepInstance(inout Walk w, uint instance_met) {
    bool entering = instance_met != kBvhNone;
    bool leaving = !entering && w.current == kBvhNone && w.triangles == 0u && bvh_instance != kNoIndex;
    if (!entering && !leaving) return;
    uint root = 0u;
    vec3 o = w.origin, d = w.direction;
    if (entering) {
        bvh_stack[w.stacked++] = w.triangles;
        bvh_stack[w.stacked++] = w.more_triangles;
        bvh_stack[w.stacked++] = w.current;
        bvh_stack[w.stacked++] = w.waiting;
        w.base = w.stacked;
        w.triangles = 0u;
        w.more_triangles = 0u;
        w.waiting = 0u;
        uint texel = instance_met * kBvhTexelsPerTriangle;
        vec4 x = bvhTriangleTexel(texel), y = bvhTriangleTexel(texel + 1u), z = bvhTriangleTexel(texel + 2u);
        vec4 at = bvhTriangleTexel(kFirstInstanceTexel + instance_met);
        o = w.origin - vec3(x.w, y.w, z.w);
        o = vec3(dot(x.xyz, o), dot(y.xyz, o), dot(z.xyz, o));
        d = vec3(dot(x.xyz, d), dot(y.xyz, d), dot(z.xyz, d));
        root = uint(at.x);
        w.current = root;
        bvh_instance = uint(at.y);
    } else {
        bvh_instance = kNoIndex;
        w.waiting = bvh_stack[--w.stacked];
        w.current = bvh_stack[--w.stacked];
        w.more_triangles = bvh_stack[--w.stacked];
        w.triangles = bvh_stack[--w.stacked];
        w.base = 0u;
    }
    w.best.t *= w.ray.direction_scale;
    vec3 lower, upper;
    treeBounds(root, lower, upper);
    if (!setUpRay(o, d, lower, upper, w.ray)) w.current = kBvhNone;
    w.boxes = boxRay(o, w.ray);
    if (leaving) w.boxes = widenedForInstances(w.boxes, lower, upper);
    w.best.t *= w.ray.distance_scale;
    w.t_min = w.t_first > 0.0F ? w.t_first * w.ray.distance_scale : 0.0F;
}

// A round is one node and one triangle, because drivers that run lanes in lockstep pay for both anyway. Rounds of a walk that has ended do nothing.
void walkOn(inout Walk w, bool any_hit) {
    uint waited = w.waiting;
    bool below = w.current != kBvhNone && w.more_triangles == 0u && stepNode(w);
    // A CPU stores lane by lane behind branches that it foretells badly: where nearly all lanes walk, storing for all of them makes walks 2 to 6 %
    // faster (lavapipe). Where many idle it costs as much.
    if (kRefilled || below) bvh_stack[w.stacked] = waited;
    w.stacked += below ? 1u : 0u;
    uint instance_met = kBvhNone;
    if (w.triangles != 0u) instance_met = stepTriangle(w, any_hit);
    if (kInstances) stepInstance(w, instance_met);
}

// The nearest hit in [max(t_min, 0), t_max), or with any_hit the first one found (see bvh_any_before). Equal distances go to the baked triangles, then to
// the lower instance, then to the lower triangle index. A ray that is not finite or has no direction hits nothing.
TraceHit traceRay(vec3 origin, vec3 direction, float t_min, float t_max, bool any_hit) {
    vec3 scene_lower, scene_upper;
    treeBounds(0u, scene_lower, scene_upper);
    Walk w;
    startWalk(w, origin, direction, t_min, t_max, scene_lower, scene_upper);
    bool walking = walks(w);
    while (walking) {
        walkOn(w, any_hit);
        // A variable of its own: what a loop's condition says is taken for granted behind the loop, even where the loop was cut.
        walking = walks(w);
    }
    bvh_walk_cut = bvh_walk_cut || walks(w);
    return hitOfWalk(w);
}

#endif
