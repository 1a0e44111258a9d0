#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
// Light that is not blocked is added to the path that asked for it.
#include "path/wavefront.glsl"

layout(local_size_x = 64) in;

struct RayTask {
    ShadowRay shadow;
    uint path;
};

RayTask takeTask(uint i) {
    RayTask task;
    task.shadow = unpackShadow(i, push.sample_index, push.bounce, task.path);
    noteTaken(kCountShadows, task.path);
    return task;
}

RayQuery queryOf(RayTask task) { return task.shadow.ray.query; }

bool passesThrough(inout RayTask task, TraceHit found) { return passesThrough(task.shadow.ray, found); }

void endTask(bool ends, RayTask task) {
    if (!ends || largest(arrivingShare(task.shadow)) <= 0.0) return;
    addRadiance(task.path, arrivingLight(task.shadow.ray.address.pixel, push.bounce + 1u, task.shadow));
}

#include "ray/list.glsl"

void main() {
    countTruncated(traceList(queueCount(push.bounce, kCountShadows)));
    endBalance();
}
