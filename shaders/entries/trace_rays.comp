#version 460
#extension GL_GOOGLE_include_directive : require
// Traces a list of rays and writes what they hit: a ray a thread.
#include "ray/listed.glsl"

layout(local_size_x = 64) in;

void main() {
    if (gl_GlobalInvocationID.x >= range.count) return;
    RayTask task = takeTask(gl_GlobalInvocationID.x);
    TraceResult found = traceRay(task.query);
    task.hit = found.hit;
    endTask(!found.truncated, task);
}
