#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
// Where the paths go on: those that hit something are queued for their next vertex, the others end in the sky.
#include "bound/queues.glsl"
#include "shared/index.h"

layout(local_size_x = 64) in;

uint g_path = 0u;

void takeRay(uint i, out vec3 origin, out vec3 direction, out float t_min, out float t_max) {
    int at = int(kRayTexels * i);
    uvec4 o = texelFetch(queue_ray_texels, at), d = texelFetch(queue_ray_texels, at + 1);
    g_path = o.w;
    if (kAlpha) addressPath(g_path, rayCountOf(g_path) - 1u);
    g_after_t = -1.0;
    origin = uintBitsToFloat(o.xyz);
    direction = uintBitsToFloat(d.xyz);
    t_min = 0.0;
    t_max = uintBitsToFloat(0x7f800000u);
}

void giveHit(bool gives, TraceHit found) {
    bool hits = gives && found.position != kNoIndex;
    if (hits) {
        storeHit(g_path, g_hit);
    } else if (gives && (kEnvironment || kSuns)) {
        if (kOrders > 0u || kClamp) addressPath(g_path, 0u);
        Path p = loadPath(g_path);
        endInSky(p);
        addRadiance(g_path, p.radiance);
    }
    uint place = appendTo(push.bounce + 1u, kCountHits, hits);
    if (hits) queue_hits[place] = g_path;
}

#include "bound/ray_list.glsl"

void main() { countLostRays(traceList(queueCount(push.bounce, kCountRays), false)); }
