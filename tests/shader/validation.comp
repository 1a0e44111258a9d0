#version 460
// Two of these, there and back, need a barrier between.
layout(local_size_x = 64) in;
layout(binding = 0) readonly buffer From { uint values[]; } from;
layout(binding = 1) writeonly buffer To { uint values[]; } to;

void main() {
    to.values[gl_GlobalInvocationID.x] = from.values[gl_GlobalInvocationID.x];
}
