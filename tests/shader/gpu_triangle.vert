#version 460
layout(binding = 0) readonly buffer Vertices { vec4 positions[]; } vertices;
layout(location = 0) flat out uint triangle;

void main() {
    gl_Position = vertices.positions[gl_VertexIndex];
    triangle = uint(gl_VertexIndex) / 3u + 1u;
}
