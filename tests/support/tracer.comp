// Traces a list of rays and writes what they hit: a ray a thread.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tracer.glsl"

void main() {
    if (gl_GlobalInvocationID.x >= push.ray_count) return;
    RayTask task = takeTask(gl_GlobalInvocationID.x);
    TraceResult found = traceRay(task.query);
    task.hit = found.hit;
    endTask(!found.truncated, task);
}
