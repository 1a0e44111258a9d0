// Textures: all texels lie in pages of one address space and are filtered here, so that no device needs bindless images and every
// device filters with the same precision.
#ifndef LICHT_BOUND_TEXTURE_GLSL
#define LICHT_BOUND_TEXTURE_GLSL

#include "bound/scene.glsl"
#include "shared/bindings.h"
#include "shared/constants.h"
#include "shared/material.h"

layout(std430, binding = kBindingTextures) readonly buffer Textures { TextureRecord textures[]; };
layout(std430, binding = kBindingTexelPages) readonly buffer TexelPages { uint words[]; } texel_pages[kTexturePages];
layout(std430, binding = kBindingSrgbTable) readonly buffer SrgbTable { float srgb_table[256]; };

// What of the texture code the scene calls for: drivers without branches run everything that is compiled in.
layout(constant_id = kConstantTexturePages) const uint kTexturePagesUsed = kTexturePages;
layout(constant_id = kConstantWideTexels) const bool kWideTexels = true;  // 16 bits per channel

// The page differs from lane to lane, which core Vulkan does not let index an array of buffers.
uint texelWord(uint page, uint word) {
    if (kTexturePagesUsed <= 1u) return texel_pages[0].words[word];
    switch (page) {
        case 0u: return texel_pages[0].words[word];
        case 1u: return texel_pages[1].words[word];
        case 2u: return texel_pages[2].words[word];
        case 3u: return texel_pages[3].words[word];
        case 4u: return texel_pages[4].words[word];
        case 5u: return texel_pages[5].words[word];
        case 6u: return texel_pages[6].words[word];
        default: return texel_pages[7].words[word];
    }
}

int wrapTexel(int i, int size, uint mode) {
    if (mode == 1u) return clamp(i, 0, size - 1);
    int period = mode == 2u ? 2 * size : size;
    int m = i % period;
    m = m < 0 ? m + period : m;
    return m < size ? m : period - 1 - m;
}

vec4 texelAt(TextureRecord t, ivec2 at, uint flags) {
    at.x = wrapTexel(at.x, int(t.width), (flags >> kSlotWrapUShift) & 3u);
    at.y = wrapTexel(at.y, int(t.height), (flags >> kSlotWrapVShift) & 3u);
    uint word = t.first_word + (uint(at.y) * t.width + uint(at.x)) * t.words_per_texel;
    uint low = texelWord(t.page, word);
    if (kWideTexels && t.words_per_texel == 2u) {
        uint high = texelWord(t.page, word + 1u);
        vec4 c = vec4(unpackUnorm2x16(low), unpackUnorm2x16(high));
        if ((flags & kSlotSrgb) == 0u) return c;
        // Between the table's entries the curve is a straight line to far below 8-bit precision.
        vec3 x = c.rgb * 255.0;
        uvec3 i = min(uvec3(x), uvec3(254u));
        vec3 f = x - vec3(i);
        vec3 from = vec3(srgb_table[i.x], srgb_table[i.y], srgb_table[i.z]);
        vec3 to = vec3(srgb_table[i.x + 1u], srgb_table[i.y + 1u], srgb_table[i.z + 1u]);
        return vec4(from + f * (to - from), c.a);
    }
    uvec4 b = uvec4(low & 255u, (low >> 8u) & 255u, (low >> 16u) & 255u, low >> 24u);
    if ((flags & kSlotSrgb) == 0u) return vec4(b) / 255.0;
    return vec4(srgb_table[b.x], srgb_table[b.y], srgb_table[b.z], float(b.w) / 255.0);
}

// Filtered value of a slot's texture at its transformed coordinates.
vec4 sampleTexture(TextureSlotRecord slot, uvec3 v, vec3 weights) {
    vec3 uv1 = vec3(uvAt(v, weights, slot.flags >> kSlotUvSetShift), 1.0);
    vec2 uv = vec2(dot(slot.u_from_uv, uv1), dot(slot.v_from_uv, uv1));
    TextureRecord t = textures[slot.texture];
    vec2 x = uv * vec2(t.width, t.height);
    // Coordinates so far out that a texel is not resolved any more (or no number at all) read the first texel instead of wandering.
    if (!(abs(x.x) < 1e9 && abs(x.y) < 1e9)) x = vec2(0.5);
    x = (slot.flags & kSlotLinear) == 0u ? floor(x) : x - 0.5;
    ivec2 i = ivec2(floor(x));
    vec2 f = x - vec2(i);
    return lerp(lerp(texelAt(t, i, slot.flags), texelAt(t, i + ivec2(1, 0), slot.flags), f.x),
                lerp(texelAt(t, i + ivec2(0, 1), slot.flags), texelAt(t, i + ivec2(1, 1), slot.flags), f.x), f.y);
}

#endif
