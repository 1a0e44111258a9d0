#version 460
// to[i] = 2 texels[i] + 1, where both may be the same buffer.
layout(local_size_x = 64) in;
layout(push_constant) uniform Push { uint count; } push;
layout(binding = 0) uniform usamplerBuffer texels;
layout(binding = 1) writeonly buffer To { uint values[]; } to;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < push.count) {
        to.values[i] = 2u * texelFetch(texels, int(i)).x + 1u;
    }
}
