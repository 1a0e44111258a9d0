// Materials, their texture slots and the textures.
#ifndef LICHT_SHARED_MATERIAL_H
#define LICHT_SHARED_MATERIAL_H
#include "index.h"

LICHT_SHARED_BEGIN

// Kinds of texture slots.
LICHT_CONSTANT uint kSlotBaseColor = 0u;
LICHT_CONSTANT uint kSlotMetallicRoughness = 1u;
LICHT_CONSTANT uint kSlotNormal = 2u;
LICHT_CONSTANT uint kSlotEmissive = 3u;
LICHT_CONSTANT uint kSlotSpecular = 4u;
LICHT_CONSTANT uint kSlotSpecularColor = 5u;
LICHT_CONSTANT uint kSlotIridescence = 6u;
LICHT_CONSTANT uint kSlotIridescenceThickness = 7u;

LICHT_CONSTANT uint kSlotLinear = 1u;      // bilinear filter
LICHT_CONSTANT uint kSlotWrapUShift = 1u;  // two bits each: 0 repeat, 1 clamp, 2 mirror
LICHT_CONSTANT uint kSlotWrapVShift = 3u;
LICHT_CONSTANT uint kSlotSrgb = 32u;  // decode RGB by the sRGB curve
LICHT_CONSTANT uint kSlotUvSetShift = 8u;

struct TextureSlotRecord {
    vec3 u_from_uv;
    uint texture;  // kNoIndex: none
    vec3 v_from_uv;
    uint flags;
};

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
    float iridescence;
    float iridescence_ior;
    float iridescence_thickness_minimum;  // nm
    float iridescence_thickness_maximum;  // and without a texture
    uint reserved0;
    uint reserved1;
    uint reserved2;
    TextureSlotRecord base_color_slot;
    TextureSlotRecord metallic_roughness_slot;
    TextureSlotRecord normal_slot;
    TextureSlotRecord emissive_slot;
    TextureSlotRecord specular_slot;
    TextureSlotRecord specular_color_slot;
    TextureSlotRecord iridescence_slot;
    TextureSlotRecord iridescence_thickness_slot;
};
LICHT_CONSTANT uint kMaterialTexels = 22u;  // of four words

LICHT_SHARED_END
#endif
