#version 460
// Every way in which a program can be told to touch a resource.
layout(local_size_x = 1) in;
layout(binding = 0) uniform samplerBuffer texels;
layout(binding = 1) uniform sampler2D sampled;
layout(binding = 2) uniform Uniforms { vec4 value; } uniforms;
layout(binding = 3) readonly buffer ReadBuffer { vec4 value; } read_buffer;
layout(binding = 4) writeonly buffer WrittenBuffer { vec4 value; } written_buffer;
layout(binding = 5) buffer ChangedBuffer { vec4 value; } changed_buffer;
layout(binding = 6) buffer MixedBuffer { readonly vec4 first; writeonly vec4 second; } mixed_buffer;
layout(binding = 7, rgba32f) uniform readonly image2D read_image;
layout(binding = 8, rgba32f) uniform writeonly image2D written_image;
layout(binding = 9, rgba32f) uniform image2D changed_image;
layout(binding = 10, rgba32f) uniform readonly imageBuffer read_texels;
layout(binding = 11, rgba32f) uniform writeonly imageBuffer written_texels;

void main() {
    vec4 sum = texelFetch(texels, 0) + texelFetch(sampled, ivec2(0), 0) + uniforms.value + read_buffer.value + mixed_buffer.first;
    sum += imageLoad(read_image, ivec2(0)) + imageLoad(changed_image, ivec2(0)) + imageLoad(read_texels, 0);
    written_buffer.value = sum;
    changed_buffer.value += sum;
    mixed_buffer.second = sum;
    imageStore(written_image, ivec2(0), sum);
    imageStore(changed_image, ivec2(0), sum);
    imageStore(written_texels, 0, sum);
}
