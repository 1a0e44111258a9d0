// Paths and their rays as they wait between the kernels of the wavefront: for each record what packs it and what unpacks it. Written as storage, read as
// texels.
#ifndef LICHT_PATH_STATE_GLSL
#define LICHT_PATH_STATE_GLSL
#include "path/path.glsl"
#include "path/store.glsl"
#include "shared/bindings.h"
#include "shared/choices.h"
#include "shared/path.h"

layout(std430, binding = kBindingQueuePaths) writeonly buffer QueuePaths { uvec4 queue_paths[]; };
layout(std430, binding = kBindingQueueRays) writeonly buffer QueueRays { uvec4 queue_rays[]; };
layout(std430, binding = kBindingQueueShadows) writeonly buffer QueueShadows { uvec4 queue_shadows[]; };
layout(binding = kBindingQueuePathTexels) uniform usamplerBuffer queue_path_texels;
layout(binding = kBindingQueueRayTexels) uniform usamplerBuffer queue_ray_texels;
layout(binding = kBindingQueueShadowTexels) uniform usamplerBuffer queue_shadow_texels;

uvec4 pathTexel(uint path, uint texel) { return texelFetch(queue_path_texels, int(path * kPathTexels + texel)); }

// All but the hit and the radiance, which other kernels than the one that extends paths write.
void packPath(uint path, Path p) {
    uint at = path * kPathTexels;
    queue_paths[at + kPathWay] = uvec4(floatBitsToUint(p.wo), floatBitsToUint(p.scatter_pdf));
    queue_paths[at + kPathThroughput] = uvec4(floatBitsToUint(p.throughput), p.bounce);
    queue_paths[at + kPathFrom] = uvec4(floatBitsToUint(p.from.position), p.address.pixel.x | (p.address.pixel.y << 16u));
    if (kHeedsGloss) queue_paths[at + kPathGloss] = uvec4(p.from.wo, p.from.gloss, p.medium, 0u);
}

SampleAddress unpackAddress(uint path, uint frame_index) {
    uint pixel = pathTexel(path, kPathFrom).w;
    return sampleAddress(uvec2(pixel & 0xffffu, pixel >> 16u), frame_index);
}

// Without what it has found so far, which stays where it is.
Path unpackPath(uint path, uint frame_index) {
    uvec4 hit = pathTexel(path, kPathHit), way = pathTexel(path, kPathWay), throughput = pathTexel(path, kPathThroughput);
    Path p = beginPath(unpackAddress(path, frame_index), Hit(hit.x, hit.y, uintBitsToFloat(hit.z), uintBitsToFloat(hit.w)), uintBitsToFloat(way.xyz));
    p.scatter_pdf = uintBitsToFloat(way.w);
    p.throughput = uintBitsToFloat(throughput.xyz);
    p.bounce = throughput.w;
    p.from.position = uintBitsToFloat(pathTexel(path, kPathFrom).xyz);
    p.from.normal = pathTexel(path, kPathRadiance).w;
    if (kHeedsGloss) {
        uvec4 gloss = pathTexel(path, kPathGloss);
        p.from.wo = gloss.x;
        p.from.gloss = gloss.y;
        p.medium = gloss.z;
    }
    return p;
}

void packHit(uint path, Hit hit) {
    queue_paths[path * kPathTexels + kPathHit] = uvec4(hit.instance, hit.primitive, floatBitsToUint(hit.b1), floatBitsToUint(hit.b2));
}

// The texel's last word is the path's: the normal of the vertex before.
void packRadiance(uint path, vec3 radiance, uint from_normal) {
    queue_paths[path * kPathTexels + kPathRadiance] = uvec4(floatBitsToUint(radiance), from_normal);
}

vec3 unpackRadiance(uint path) { return uintBitsToFloat(pathTexel(path, kPathRadiance).xyz); }

void addRadiance(uint path, vec3 radiance) { packRadiance(path, unpackRadiance(path) + radiance, pathTexel(path, kPathRadiance).w); }

void packRay(uint place, RayQuery ray, uint path) {
    uint at = kRayTexels * place;
    queue_rays[at + kRayOrigin] = uvec4(floatBitsToUint(ray.origin), path);
    queue_rays[at + kRayDirection] = uvec4(floatBitsToUint(ray.direction), 0u);
}

SceneRay unpackRay(uint place, uint frame_index, uint bounce, out uint path) {
    int at = int(kRayTexels * place);
    uvec4 o = texelFetch(queue_ray_texels, at + int(kRayOrigin)), d = texelFetch(queue_ray_texels, at + int(kRayDirection));
    path = o.w;
    RayQuery ray = pathQuery(uintBitsToFloat(o.xyz), uintBitsToFloat(d.xyz));
    return sceneRay(ray, unpackAddress(path, frame_index), kRayOnward + kRaysPerBounce * bounce);
}

void packShadow(uint place, ShadowRay shadow, uint path) {
    uint at = kShadowTexels * place;
    RayQuery ray = shadow.ray.query;
    queue_shadows[at + kShadowOrigin] = uvec4(floatBitsToUint(ray.origin), floatBitsToUint(ray.t_max));
    queue_shadows[at + kShadowDirection] = uvec4(floatBitsToUint(ray.direction), path);
    queue_shadows[at + kShadowLight] = uvec4(floatBitsToUint(shadow.light), shadow.target);
    if (kLightSpheres) queue_shadows[at + kShadowEnough] = uvec4(floatBitsToUint(ray.t_enough), 0u, 0u, 0u);
}

ShadowRay unpackShadow(uint place, uint frame_index, uint bounce, out uint path) {
    int at = int(kShadowTexels * place);
    uvec4 o = texelFetch(queue_shadow_texels, at + int(kShadowOrigin)), d = texelFetch(queue_shadow_texels, at + int(kShadowDirection));
    uvec4 light = texelFetch(queue_shadow_texels, at + int(kShadowLight));
    float t_enough = kLightSpheres ? uintBitsToFloat(texelFetch(queue_shadow_texels, at + int(kShadowEnough)).x) : 0.0;
    path = d.w;
    RayQuery ray = shadowQuery(uintBitsToFloat(o.xyz), uintBitsToFloat(d.xyz), uintBitsToFloat(o.w), t_enough);
    SceneRay traced = sceneRay(ray, unpackAddress(path, frame_index), kRayToLight + kRaysPerBounce * bounce);
    return ShadowRay(traced, light.w, uintBitsToFloat(light.xyz), true);
}

#endif
