// Paths in queues: the same estimator as path.comp, cut where rays are traced, so that only what is alive is worked on (Laine, Karras, Aila 2013,
// Megakernels Considered Harmful: Wavefront Path Tracing on GPUs). Written as storage, read as texels.
#ifndef LICHT_BOUND_QUEUES_GLSL
#define LICHT_BOUND_QUEUES_GLSL
#include "bound/adaptive.glsl"
#include "bound/gbuffer.glsl"
#include "bound/orders.glsl"
#include "shared/bindings.h"
#include "shared/choices.h"
#include "shared/queue_records.h"

layout(push_constant) uniform Push { QueuePush push; };
layout(std430, binding = kBindingQueueCounts) buffer QueueCounts { uint queue_counts[]; };
layout(std430, binding = kBindingQueuePaths) writeonly buffer QueuePaths { uvec4 queue_paths[]; };
layout(std430, binding = kBindingQueueHits) writeonly buffer QueueHits { uint queue_hits[]; };
layout(std430, binding = kBindingQueueRays) writeonly buffer QueueRays { uvec4 queue_rays[]; };
layout(std430, binding = kBindingQueueShadows) writeonly buffer QueueShadows { uvec4 queue_shadows[]; };
layout(binding = kBindingQueuePathTexels) uniform usamplerBuffer queue_path_texels;
layout(binding = kBindingQueueHitTexels) uniform usamplerBuffer queue_hit_texels;
layout(binding = kBindingQueueRayTexels) uniform usamplerBuffer queue_ray_texels;
layout(binding = kBindingQueueShadowTexels) uniform usamplerBuffer queue_shadow_texels;

void onRay(vec3 origin, vec3 direction, float t_max, bool any_hit) {}

// What traceList() returns.
void countLostRays(uint lost) {
    if (lost > 0u) atomicAdd(counters.cut_walks, lost);
}

uint queueCount(uint bounce, uint which) { return queue_counts[kQueueCounts * bounce + which]; }

// A place in a queue for every invocation that wants one; called by all together, so that one atomic serves a subgroup. The order of places is left to
// chance; no path depends on it.
uint appendTo(uint bounce, uint which, bool wanted) {
    uvec4 ballot = subgroupBallot(wanted);
    uint total = subgroupBallotBitCount(ballot);
    uint first = 0u;
    if (subgroupElect() && total > 0u) first = atomicAdd(queue_counts[kQueueCounts * bounce + which], total);
    return subgroupBroadcastFirst(first) + subgroupBallotExclusiveBitCount(ballot);
}

uvec4 pathBits(uint path, uint texel) { return texelFetch(queue_path_texels, int(path * kPathTexels + texel)); }

uint rayCountOf(uint path) { return pathBits(path, 2u).w >> 16u; }

void addressPixel(uvec2 pixel) { g_address = SampleAddress(pixel, sampleIndexOf(pixel, frame.view.size.x, push.sample_index), frame.seed); }

// Whose rays are traced from here on.
void addressPath(uint path, uint rays_before) {
    uint pixel = pathBits(path, 3u).w;
    addressPixel(uvec2(pixel & 0xffffu, pixel >> 16u));
    g_rays_before = rays_before;
}

// Without what it has found so far, which stays where it is.
Path loadPath(uint path) {
    uvec4 h = pathBits(path, 0u), d = pathBits(path, 1u), t = pathBits(path, 2u), f = pathBits(path, 3u);
    Path p = beginPath(Hit(h.x, h.y, uintBitsToFloat(h.z), uintBitsToFloat(h.w)), uintBitsToFloat(d.xyz));
    p.scatter_pdf = uintBitsToFloat(d.w);
    p.throughput = uintBitsToFloat(t.xyz);
    p.bounce = t.w & 0xffffu;
    p.from = LightAsker(uintBitsToFloat(f.xyz), pathBits(path, 4u).w, 0u, 0u);
    if (kGlossy && kLights == kLightsTree) {
        uvec4 g = pathBits(path, 5u);
        p.from.wo = g.x;
        p.from.gloss = g.y;
    }
    return p;
}

void storePath(uint path, Path p, uint rays_before, uvec2 pixel) {
    uint at = path * kPathTexels;
    queue_paths[at + 1u] = uvec4(floatBitsToUint(p.wo), floatBitsToUint(p.scatter_pdf));
    queue_paths[at + 2u] = uvec4(floatBitsToUint(p.throughput), p.bounce | (rays_before << 16u));
    queue_paths[at + 3u] = uvec4(floatBitsToUint(p.from.position), pixel.x | (pixel.y << 16u));
    if (kGlossy && kLights == kLightsTree) queue_paths[at + 5u] = uvec4(p.from.wo, p.from.gloss, 0u, 0u);
}

void storeHit(uint path, Hit hit) { queue_paths[path * kPathTexels] = uvec4(hit.instance, hit.primitive, floatBitsToUint(hit.b1), floatBitsToUint(hit.b2)); }

vec3 radianceOf(uint path) { return uintBitsToFloat(pathBits(path, 4u).xyz); }

// With the normal of the vertex before, which shares the texel.
void storeRadiance(uint path, vec3 radiance, uint from_normal) { queue_paths[path * kPathTexels + 4u] = uvec4(floatBitsToUint(radiance), from_normal); }

void addRadiance(uint path, vec3 radiance) {
    uvec4 found = pathBits(path, 4u);
    storeRadiance(path, uintBitsToFloat(found.xyz) + radiance, found.w);
}

// Paths are numbered by the tiles of 8 by 8 pixels that started them.
uint pathOfThread() { return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * kQueueGroup + gl_LocalInvocationIndex; }

uvec2 pixelOfThread() { return uvec2(gl_GlobalInvocationID.x, push.first_row + gl_GlobalInvocationID.y); }

bool insideSlice(uvec2 pixel) { return pixel.x < frame.view.size.x && pixel.y < min(push.first_row + push.row_count, frame.view.size.y); }

#endif
