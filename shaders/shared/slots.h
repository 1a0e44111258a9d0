// The texture slots and the extensions' blocks of a material, each said once. Loading, checking, uploading and sampling follow from these lists.
#ifndef LICHT_SHARED_SLOTS_H
#define LICHT_SHARED_SLOTS_H
#include "seam.h"

LICHT_SHARED_BEGIN

// X(number, name, whether RGB is decoded by the sRGB curve, in words, extension of glTF that brings it, its key there). GLSL has no strings; its uses of
// the list leave them out.
#define LICHT_TEXTURE_SLOTS(X)                                                                                              \
    X(0u, BaseColor, true, "base colour", "", "baseColorTexture")                                                           \
    X(1u, MetallicRoughness, false, "metallic-roughness", "", "metallicRoughnessTexture")                                   \
    X(2u, Normal, false, "normal", "", "normalTexture")                                                                     \
    X(3u, Emissive, true, "emissive", "", "emissiveTexture")                                                                \
    X(4u, Specular, false, "specular", "KHR_materials_specular", "specularTexture")                                         \
    X(5u, SpecularColor, true, "specular colour", "KHR_materials_specular", "specularColorTexture")                         \
    X(6u, Iridescence, false, "iridescence", "KHR_materials_iridescence", "iridescenceTexture")                             \
    X(7u, IridescenceThickness, false, "iridescence thickness", "KHR_materials_iridescence", "iridescenceThicknessTexture") \
    X(8u, Clearcoat, false, "clearcoat", "KHR_materials_clearcoat", "clearcoatTexture")                                     \
    X(9u, ClearcoatRoughness, false, "clearcoat roughness", "KHR_materials_clearcoat", "clearcoatRoughnessTexture")         \
    X(10u, ClearcoatNormal, false, "clearcoat normal", "KHR_materials_clearcoat", "clearcoatNormalTexture")

#define LICHT_SLOT_NUMBER(number, name, srgb, words, extension, key) LICHT_CONSTANT uint kSlot##name = number;
#define LICHT_SLOT_ONE(number, name, srgb, words, extension, key) +1u
LICHT_TEXTURE_SLOTS(LICHT_SLOT_NUMBER)
LICHT_CONSTANT uint kSlotCount = 0u LICHT_TEXTURE_SLOTS(LICHT_SLOT_ONE);

// What an extension adds to a material: four words, of which the first is a float and not zero where the extension shows. X(number, name, member of
// licht::Material); the record is <name>Record of shared/material.h.
#define LICHT_MATERIAL_BLOCKS(X)    \
    X(0u, Iridescence, iridescence) \
    X(1u, Clearcoat, clearcoat)

#define LICHT_BLOCK_NUMBER(number, name, member) LICHT_CONSTANT uint kBlock##name = number;
LICHT_MATERIAL_BLOCKS(LICHT_BLOCK_NUMBER)

LICHT_SHARED_END
#endif
