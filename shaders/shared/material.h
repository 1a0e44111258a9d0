// Materials, their texture slots, the extensions' blocks, and the textures.
#ifndef LICHT_SHARED_MATERIAL_H
#define LICHT_SHARED_MATERIAL_H
#include "index.h"

LICHT_SHARED_BEGIN

LICHT_CONSTANT uint kSlotLinear = 1u;      // bilinear filter
LICHT_CONSTANT uint kSlotWrapUShift = 1u;  // two bits each: 0 repeat, 1 clamp, 2 mirror
LICHT_CONSTANT uint kSlotWrapVShift = 3u;
LICHT_CONSTANT uint kSlotSrgb = 32u;  // decode RGB by the sRGB curve
LICHT_CONSTANT uint kSlotUvSetShift = 8u;

struct TextureSlotRecord {
    vec3 u_from_uv;
    uint texture;
    vec3 v_from_uv;
    uint flags;
};
LICHT_CONSTANT uint kSlotWords = 2u;  // of four

LICHT_CONSTANT uint kTexelsPerPageLog2 = 24u;  // 64 MiB of RGBA8 a page: half the storage buffer that every device guarantees
LICHT_CONSTANT uint kTexturePages = 8u;

struct TextureRecord {
    uint page;
    uint first_word;
    uint width;
    uint height;
    uint words_per_texel;  // 1: RGBA8, 2: RGBA16
    uint reserved0;
    uint reserved1;
    uint reserved2;
};

LICHT_CONSTANT uint kMaterialUnlit = 1u;
LICHT_CONSTANT uint kMaterialAlphaMask = 2u;
LICHT_CONSTANT uint kMaterialAlphaBlend = 4u;
LICHT_CONSTANT uint kMaterialDoubleSided = 8u;

struct MaterialRecord {
    vec4 base_color;
    vec3 emission;  // cd/m^2
    float metallic;
    vec3 specular_color;
    float roughness;
    float specular;
    float dielectric_f0;  // ((ior - 1) / (ior + 1))^2
    float normal_scale;
    float alpha_cutoff;
    uint flags;
    uint slots;         // bits 1 << kSlot... of those that read a texture
    uint blocks;        // bits 1 << kBlock... of those that are there
    uint first_detail;  // where its slots stand in the list of details, in order; its blocks follow
};
LICHT_CONSTANT uint kMaterialTexels = 5u;  // of four words

struct IridescenceRecord {
    float factor;             // share of the thin film
    float ior;                // of the film, at least 1
    float thickness_minimum;  // nm, where the thickness texture is 0
    float thickness_maximum;  // nm, where it is 1, and without one
};

struct ClearcoatRecord {
    float factor;  // share of the surface that it covers
    float roughness;
    float normal_scale;
    float reserved;
};

LICHT_SHARED_END
#endif
