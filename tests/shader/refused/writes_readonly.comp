#version 460
// Must not compile: what is `readonly` counts as never written.
layout(local_size_x = 1) in;
layout(binding = 0) readonly buffer Values { uint values[]; };

void main() { values[0] = 1u; }
