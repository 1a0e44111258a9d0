#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
// Where the paths go on: those that hit something are queued for their next vertex, the others end in the sky.
#include "path/wavefront.glsl"
#include "shared/index.h"

layout(local_size_x = 64) in;

struct RayTask {
    SceneRay ray;
    uint path;
};

RayTask takeTask(uint i) {
    RayTask task;
    task.ray = unpackRay(i, push.sample_index, push.bounce, task.path);
    noteTaken(kCountRays, task.path);
    return task;
}

RayQuery queryOf(RayTask task) { return task.ray.query; }

bool passesThrough(inout RayTask task, TraceHit found) { return passesThrough(task.ray, found); }

void endTask(bool ends, RayTask task) {
    bool hits = ends && task.ray.hit.instance != kNoIndex;
    if (hits) {
        packHit(task.path, task.ray.hit);
    } else if (ends && (kEnvironment || kSuns)) {
        Path p = unpackPath(task.path, push.sample_index);
        endInSky(p);
        addRadiance(task.path, p.radiance);
    }
    uint place = enqueue(push.bounce + 1u, kCountHits, task.path, hits);
    if (hits) queue_hits[place] = task.path;
}

#include "ray/list.glsl"

void main() {
    countTruncated(traceList(queueCount(push.bounce, kCountRays)));
    endBalance();
}
