#version 460
// One of everything that a kernel can be bound to.
layout(local_size_x = 8, local_size_y = 4) in;
layout(constant_id = 3) const uint kBias = 1u;
layout(constant_id = 4) const bool kNegate = false;

struct Inner {
    vec3 direction;
    float reach;
};
struct Item {
    vec4 color;
    Inner inner;
    uint flags;
};

layout(push_constant) uniform Push {
    uvec2 size;
    float scale;
} push;
layout(binding = 0) uniform samplerBuffer table;
layout(binding = 1) uniform Settings { vec4 offset; } settings;
layout(binding = 2) readonly buffer Items { Item items[]; };
layout(binding = 3) writeonly buffer Result { float values[]; } result;
layout(binding = 4, r32f) uniform writeonly image2D picture;
layout(binding = 5) readonly buffer Page { uint words[]; } pages[3];
layout(binding = 6) readonly buffer Unused { uint words[]; } unused;

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, push.size))) {
        return;
    }
    uint index = pixel.y * push.size.x + pixel.x;
    float value = texelFetch(table, int(index)).y * push.scale + settings.offset.z + float(kBias);
    value += items[1].inner.reach + float(items[1].flags);
    value += float(pages[0].words[0] + pages[1].words[0] + pages[2].words[0]);
    result.values[index] = kNegate ? -value : value;
    imageStore(picture, ivec2(pixel), vec4(float(index)));
}
