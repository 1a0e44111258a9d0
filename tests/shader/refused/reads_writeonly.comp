#version 460
// Must not compile: what is `writeonly` counts as never read.
layout(local_size_x = 1) in;
layout(binding = 0) writeonly buffer Values { uint values[]; };

void main() { values[1] = values[0]; }
