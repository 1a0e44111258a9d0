#version 460
layout(binding = 1) buffer Seen { uint count; } seen;
layout(location = 0) flat in uint triangle;
layout(location = 0) out uint color;

void main() {
    atomicAdd(seen.count, 1u);
    color = triangle;
}
