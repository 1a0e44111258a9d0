#version 460
// A running sum through a pair of images: this frame's texel is the last one's and one more.
layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Push { uint has_previous; } push;
layout(binding = 0, rgba32f) uniform writeonly image2D sum;
layout(binding = 1, rgba32f) uniform readonly image2D previous_sum;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(sum)))) return;
    vec4 before = push.has_previous != 0u ? imageLoad(previous_sum, pixel) : vec4(0.0);
    imageStore(sum, pixel, before + vec4(1.0));
}
