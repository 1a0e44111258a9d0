#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
// One vertex of every path that hit something: what it emits, and the two rays that leave it.
#include "path/wavefront.glsl"

layout(local_size_x = 64) in;

void main() {
    bool on = gl_GlobalInvocationID.x < queueCount(push.bounce, kCountHits);
    uint path = 0u;
    Path p;
    ShadowRay to_light = kNoShadowRay;
    SceneRay onward;
    bool goes_on = false;
    if (on) {
        path = texelFetch(queue_hit_texels, int(gl_GlobalInvocationID.x)).x;
        noteTaken(kCountHits, path);
        p = unpackPath(path, push.sample_index);
        PathCounts counts = kNothingCounted;
        extendPath(p, counts, to_light, onward);
        storeCounts(counts);
        packRadiance(path, unpackRadiance(path) + p.radiance, p.from.normal);
        goes_on = p.alive;
        if (goes_on) packPath(path, p);
    }
    uint place = enqueue(push.bounce, kCountShadows, path, to_light.wanted);
    if (to_light.wanted) packShadow(place, to_light, path);
    place = enqueue(push.bounce, kCountRays, path, goes_on);
    if (goes_on) packRay(place, onward.query, path);
    endBalance();
}
