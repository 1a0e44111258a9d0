#version 460
// to[i] = 3 from[i] + 1, a step that cannot be reordered unnoticed.
layout(local_size_x = 64) in;
layout(push_constant) uniform Push { uint count; } push;
layout(binding = 0) readonly buffer From { uint values[]; } from;
layout(binding = 1) writeonly buffer To { uint values[]; } to;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < push.count) {
        to.values[i] = 3u * from.values[i] + 1u;
    }
}
