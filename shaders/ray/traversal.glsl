// Follows a ray through the wide tree of shared/bvh_layout.h. The twin of engine/bvh/traverse.cpp.
// A ray goes in as a value and what it met comes out as one; only the stack is kept outside of both.
#ifndef LICHT_RAY_TRAVERSAL_GLSL
#define LICHT_RAY_TRAVERSAL_GLSL
#include "bound/instance_effect.glsl"
#include "pure/finite.glsl"
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
// kConstantRaysPerThread; more than one: lanes are refilled (list.glsl), as suits devices that run them in lockstep.
layout(constant_id = kConstantRaysPerThread) const uint kRaysPerThread = 1u;
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

// A ray as the tree is asked about it: the nearest hit in [max(t_min, 0), t_max), or any that is nearer than t_enough.
struct RayQuery {
    vec3 origin;          // world
    vec3 direction;       // world, of any length: distances are in its units
    float t_min;
    float t_max;
    float t_enough;       // a hit nearer than this ends the traversal. 0: none does, the nearest is wanted; infinity: any does
    uint from_instance;   // a shader that wants only what comes behind a hit reads these (acceptHit): of hits at t_min those count that are not
    uint from_triangle;   // before, by instance and triangle
};

const RayQuery kNoRayQuery = RayQuery(vec3(0.0), vec3(0.0), 0.0, 0.0, 0.0, kNoIndex, 0u);  // hits nothing

RayQuery rayQuery(vec3 origin, vec3 direction, float t_max, float t_enough) { return RayQuery(origin, direction, 0.0, t_max, t_enough, kNoIndex, 0u); }

struct TraceHit {
    uint position;  // in the leaves' order; kNoIndex: nothing was hit
    uint instance;  // kNoIndex: of the world's own, baked triangles
    float t;
    float b1;       // barycentric weights of the second and third vertex
    float b2;
};

const TraceHit kNoTraceHit = TraceHit(kNoIndex, kNoIndex, 0.0, 0.0, 0.0);

// truncated: the driver ended the traversal before it was done, so there may be a nearer hit. The lavapipe of Mesa 22.3 lets all loops of an invocation
// together run 65,535 rounds and then leaves them without a word. A round is one node and one triangle, so only huge stacks of overlapping triangles get
// there. Entry shaders report it; a picture in which it happened is wrong.
struct TraceResult {
    TraceHit hit;
    bool truncated;
};

// The including shader defines whether a triangle that the ray meets counts (alpha, culling). `position` is in the leaves' order, `t` as in the query.
bool acceptHit(RayQuery ray, uint instance, uint position, float t);

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
struct Traversal {
    uint instance;       // in whose object space the ray is; kNoIndex: the world, and baked triangles
    RaySetup setup;      // in that space, as all below
    BoxRay boxes;
    float t_min;         // scaled as `setup` is
    float t_enough;
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

// Not a member of Traversal, because GLSL neither assigns nor returns what holds an array that a specialisation constant sizes.
uint bvh_stack[kBvhStackSize + 1u];  // one more, because kRefilled writes behind the last entry

bool goesOn(Traversal s) { return s.current != kBvhNone || s.triangles != 0u || (kInstances && s.instance != kNoIndex); }

// scene_lower, scene_upper: treeBounds(0). A ray that is not finite or has no direction hits nothing.
Traversal startTraversal(RayQuery ray, vec3 scene_lower, vec3 scene_upper) {
    Traversal s;
    bool fine = setUpRay(ray.origin, ray.direction, scene_lower, scene_upper, s.setup);
    fine = fine && ray.t_min < ray.t_max && max(floatBitsToUint(ray.t_min) << 1u, floatBitsToUint(ray.t_max) << 1u) <= 0xff000000u;  // no NaN
    s.t_min = ray.t_min > 0.0F ? ray.t_min * s.setup.distance_scale : 0.0F;
    s.t_enough = ray.t_enough > 0.0F ? min(ray.t_enough, ray.t_max) * s.setup.distance_scale : 0.0F;
    s.boxes = boxRay(ray.origin, s.setup);
    if (kInstances) s.boxes = widenedForInstances(s.boxes, scene_lower, scene_upper);
    s.instance = kNoIndex;
    s.best = TraceHit(kNoIndex, kNoIndex, ray.t_max * s.setup.distance_scale, 0.0F, 0.0F);
    s.best_triangle = -1.0F;  // nothing comes before a range's end
    s.current = fine ? 0u : kBvhNone;
    s.waiting = 0u;
    s.triangles = 0u;
    s.more_triangles = 0u;
    s.stacked = 0u;
    s.base = 0u;
    return s;
}

// What was hit, with its distance as in the query. The traversal has ended.
TraceHit hitOf(Traversal s) {
    s.best.t *= s.setup.direction_scale;
    return s.best;
}

// Takes the hit if it is nearer than the best, or as near and of a lower triangle.
void offerHit(RayQuery ray, uint position, float triangle, TriangleHit hit, inout Traversal s) {
    bool before = kInstances && s.instance != s.best.instance ? s.instance + 1u < s.best.instance + 1u : triangle < s.best_triangle;
    bool nearer = hit.t < s.best.t || (hit.t == s.best.t && before);
    if (hit.t >= s.t_min && nearer && acceptHit(ray, s.instance, position, hit.t * s.setup.direction_scale)) {
        s.best = TraceHit(position, s.instance, hit.t, hit.b1, hit.b2);
        s.best_triangle = triangle;
    }
}

// Returns whether the group that waited before waits below a new one.
bool stepNode(inout Traversal s) {
    NodeHits hits = meetNode(s.boxes, s.current, s.t_min, s.best.t);
    uint found = hits.triangles != 0u ? makeGroup(hits.triangle_base, hits.triangles, false) : 0u;
    s.more_triangles = s.triangles != 0u ? found : 0u;
    s.triangles = s.triangles != 0u ? s.triangles : found;

    // On to the nearest child while its siblings wait, or to the next that waits.
    uint siblings = hits.nodes & ~(1u << hits.nearest);
    bool below = siblings != 0u && s.waiting != 0u;
    if (siblings != 0u) s.waiting = makeGroup(hits.child_base, siblings, hits.reversed);
    if (hits.nodes != 0u) {
        s.current = hits.child_base + hits.nearest;
    } else {
        s.current = s.waiting != 0u ? firstOfGroup(s.waiting) : kBvhNone;
        s.waiting = s.waiting != 0u ? withoutFirst(s.waiting) : 0u;
        if (s.waiting != 0u && (s.waiting & kGroupBits) == 0u) {
            s.waiting = 0u;
            if (s.stacked > s.base) s.waiting = bvh_stack[--s.stacked];
        }
    }
    return below;
}

// Returns the position of the instance to enter in this round, or kBvhNone.
uint stepTriangle(RayQuery ray, inout Traversal s) {
    uint position = firstOfGroup(s.triangles);
    s.triangles = withoutFirst(s.triangles);
    bool left = (s.triangles & kGroupBits) != 0u;
    s.triangles = left ? s.triangles : s.more_triangles;
    s.more_triangles = left ? s.more_triangles : 0u;

    uint texel = position * kBvhTexelsPerTriangle;
    vec4 v0 = bvhTriangleTexel(texel);
    TriangleHit hit;
    bool met = testTriangle(s.setup, v0.xyz, bvhTriangleTexel(texel + 1u).xyz, bvhTriangleTexel(texel + 2u).xyz, hit);
    bool is_instance = kInstances && position >= kFirstInstancePosition;
    if (met && !is_instance) offerHit(ray, position, v0.w, hit, s);
    // Nothing was hit: best.t is t_max, which t_enough does not exceed.
    bool enough = s.t_enough > 0.0F && s.best.t < s.t_enough;
    s.triangles = enough ? 0u : s.triangles;
    s.more_triangles = enough ? 0u : s.more_triangles;
    s.current = enough ? kBvhNone : s.current;
    if (kInstances && enough) s.instance = kNoIndex;
    return is_instance ? position : kBvhNone;
}

// Into an instance, or back from one. In the round and not outside of it (as a loop that lanes leave and enter again): 10 % faster on lavapipe, where
// lanes would wait for each other. best.t stays the same place, as t_enough does.
void stepInstance(RayQuery ray, uint instance_met, inout Traversal s) {
    bool entering = instance_met != kBvhNone;
    bool leaving = !entering && s.current == kBvhNone && s.triangles == 0u && s.instance != kNoIndex;
    if (!entering && !leaving) return;
    uint root = 0u;
    vec3 o = ray.origin, d = ray.direction;
    if (entering) {
        bvh_stack[s.stacked++] = s.triangles;
        bvh_stack[s.stacked++] = s.more_triangles;
        bvh_stack[s.stacked++] = s.current;
        bvh_stack[s.stacked++] = s.waiting;
        s.base = s.stacked;
        s.triangles = 0u;
        s.more_triangles = 0u;
        s.waiting = 0u;
        uint texel = instance_met * kBvhTexelsPerTriangle;
        vec4 x = bvhTriangleTexel(texel), y = bvhTriangleTexel(texel + 1u), z = bvhTriangleTexel(texel + 2u);
        vec4 at = bvhTriangleTexel(kFirstInstanceTexel + instance_met);
        o = ray.origin - vec3(x.w, y.w, z.w);
        o = vec3(dot(x.xyz, o), dot(y.xyz, o), dot(z.xyz, o));
        d = vec3(dot(x.xyz, d), dot(y.xyz, d), dot(z.xyz, d));
        root = uint(at.x);
        s.current = root;
        s.instance = uint(at.y);
    } else {
        s.instance = kNoIndex;
        s.waiting = bvh_stack[--s.stacked];
        s.current = bvh_stack[--s.stacked];
        s.more_triangles = bvh_stack[--s.stacked];
        s.triangles = bvh_stack[--s.stacked];
        s.base = 0u;
    }
    s.best.t *= s.setup.direction_scale;
    s.t_enough *= s.setup.direction_scale;
    vec3 lower, upper;
    treeBounds(root, lower, upper);
    if (!setUpRay(o, d, lower, upper, s.setup)) s.current = kBvhNone;
    s.boxes = boxRay(o, s.setup);
    if (leaving) s.boxes = widenedForInstances(s.boxes, lower, upper);
    s.best.t *= s.setup.distance_scale;
    s.t_enough *= s.setup.distance_scale;
    s.t_min = ray.t_min > 0.0F ? ray.t_min * s.setup.distance_scale : 0.0F;
}

// A round is one node and one triangle, because drivers that run lanes in lockstep pay for both anyway. Rounds of a traversal that has ended do nothing.
void stepTraversal(RayQuery ray, inout Traversal s) {
    uint waited = s.waiting;
    bool below = s.current != kBvhNone && s.more_triangles == 0u && stepNode(s);
    // A CPU stores lane by lane behind branches that it foretells badly: where nearly all lanes go on, storing for all of them is faster. Where many
    // idle it costs as much.
    if (kRefilled || below) bvh_stack[s.stacked] = waited;
    s.stacked += below ? 1u : 0u;
    uint instance_met = kBvhNone;
    if (s.triangles != 0u) instance_met = stepTriangle(ray, s);
    if (kInstances) stepInstance(ray, instance_met, s);
}

// Equal distances go to the baked triangles, then to the lower instance, then to the lower triangle index.
TraceResult traceRay(RayQuery ray) {
    vec3 scene_lower, scene_upper;
    treeBounds(0u, scene_lower, scene_upper);
    Traversal s = startTraversal(ray, scene_lower, scene_upper);
    bool going = goesOn(s);
    while (going) {
        stepTraversal(ray, s);
        // A variable of its own: what a loop's condition says is taken for granted behind the loop, even where the loop was truncated.
        going = goesOn(s);
    }
    return TraceResult(hitOf(s), goesOn(s));
}

#endif
