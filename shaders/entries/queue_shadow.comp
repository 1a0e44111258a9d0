#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
// Light that is not blocked is added to the path that asked for it.
#include "bound/queues.glsl"
#include "shared/index.h"

layout(local_size_x = 64) in;

uint g_path = 0u;
vec3 g_light = vec3(0.0);
uint g_target = kNoIndex;

void takeRay(uint i, out vec3 origin, out vec3 direction, out float t_min, out float t_max) {
    int at = int(kShadowTexels * i);
    uvec4 o = texelFetch(queue_shadow_texels, at), d = texelFetch(queue_shadow_texels, at + 1), c = texelFetch(queue_shadow_texels, at + 2);
    g_path = d.w;
    g_light = uintBitsToFloat(c.xyz);
    if (kAlpha) addressPath(g_path, c.w & ((1u << kShadowTargetShift) - 1u));
    g_after_t = -1.0;
    origin = uintBitsToFloat(o.xyz);
    direction = uintBitsToFloat(d.xyz);
    t_min = 0.0;
    t_max = uintBitsToFloat(o.w);
    if (kLightSpheres) {
        g_target = (c.w >> kShadowTargetShift) - 1u;
        seekTarget(g_target, t_max);
        t_max = g_target == kNoIndex ? t_max : 1.0;
    }
}

void giveHit(bool gives, TraceHit found) {
    bool arrives = kLightSpheres ? g_hit.instance == g_target : found.position == kNoIndex;
    if (!gives || !arrives) return;
    if (kOrders > 0u || kClamp) addressPath(g_path, 0u);
    addRadiance(g_path, foundLight(push.bounce + 1u, g_light));
}

#include "bound/ray_list.glsl"

void main() { countLostRays(traceList(queueCount(push.bounce, kCountShadows), !kAlpha)); }
