#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
// One vertex of every path that hit something: what it emits, and the two rays that leave it.
#include "bound/queues.glsl"
#include "shared/index.h"

layout(local_size_x = 64) in;

void main() {
    bool on = gl_GlobalInvocationID.x < queueCount(push.bounce, kCountHits);
    uint path = 0u, rays_before = 0u;
    Path p;
    RayQuery light_ray = kNoRayQuery, path_ray = kNoRayQuery;
    vec3 direct = vec3(0.0);
    if (on) {
        path = texelFetch(queue_hit_texels, int(gl_GlobalInvocationID.x)).x;
        rays_before = rayCountOf(path);
        addressPath(path, rays_before);
        p = loadPath(path);
        direct = extendPath(p, light_ray, path_ray);
        countEnvironmentTries();
        storeRadiance(path, radianceOf(path) + p.radiance, p.from.normal);
        if (path_ray.wanted) storePath(path, p, rays_before + (light_ray.wanted ? 2u : 1u), g_address.pixel);
    }
    uint at = kShadowTexels * appendTo(push.bounce, kCountShadows, light_ray.wanted);
    if (light_ray.wanted) {
        float end = kLightSpheres && light_ray.target != kNoIndex ? light_ray.t_enough : light_ray.t_max;
        queue_shadows[at] = uvec4(floatBitsToUint(light_ray.origin), floatBitsToUint(end));
        queue_shadows[at + 1u] = uvec4(floatBitsToUint(light_ray.direction), path);
        queue_shadows[at + 2u] = uvec4(floatBitsToUint(direct), rays_before | ((light_ray.target + 1u) << kShadowTargetShift));
    }
    at = kRayTexels * appendTo(push.bounce, kCountRays, path_ray.wanted);
    if (path_ray.wanted) {
        queue_rays[at] = uvec4(floatBitsToUint(path_ray.origin), path);
        queue_rays[at + 1u] = uvec4(floatBitsToUint(path_ray.direction), 0u);
    }
}
