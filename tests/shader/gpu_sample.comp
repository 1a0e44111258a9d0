#version 460
// Reads an integer image through a sampler.
layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Push { uvec2 size; } push;
layout(binding = 0) uniform usampler2D picture;
layout(binding = 1) writeonly buffer Result { uint values[]; } result;

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (all(lessThan(pixel, push.size))) {
        result.values[pixel.y * push.size.x + pixel.x] = texelFetch(picture, ivec2(pixel), 0).x;
    }
}
