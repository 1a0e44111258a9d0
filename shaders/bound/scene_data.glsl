// The scene's records, fetched. Drivers that run lanes in lockstep load storage buffers lane by lane and word by word; a texel buffer hands them four
// words of every lane at once (measured: a third of a sample's time in a simple scene was loads). Where texel buffers are too small for the scene the
// same records are read from storage buffers.
#ifndef LICHT_BOUND_SCENE_DATA_GLSL
#define LICHT_BOUND_SCENE_DATA_GLSL

#include "shared/bindings.h"
#include "shared/constants.h"
#include "shared/geometry.h"
#include "shared/material.h"
#include "shared/slots.h"

layout(constant_id = kConstantSceneInStorage) const bool kSceneInStorage = false;

layout(binding = kBindingVertexTexels) uniform usamplerBuffer vertex_texels;
layout(binding = kBindingTriangleIndexTexels) uniform usamplerBuffer triangle_index_texels;  // R32UI
layout(binding = kBindingInstanceTexels) uniform usamplerBuffer instance_texels;
layout(binding = kBindingMaterialTexels) uniform usamplerBuffer material_texels;
layout(binding = kBindingMaterialDetailTexels) uniform usamplerBuffer material_detail_texels;
layout(std430, binding = kBindingVertices) readonly buffer Vertices { VertexRecord vertices[]; };
layout(std430, binding = kBindingTriangleIndices) readonly buffer TriangleIndices { uint triangle_indices[]; };
layout(std430, binding = kBindingInstances) readonly buffer Instances { InstanceRecord instances[]; };
layout(std430, binding = kBindingMaterials) readonly buffer Materials { MaterialRecord materials[]; };
layout(std430, binding = kBindingMaterialDetails) readonly buffer MaterialDetails { uvec4 material_details[]; };

VertexRecord vertexAt(uint i) {
    if (kSceneInStorage) return vertices[i];
    vec4 a = uintBitsToFloat(texelFetch(vertex_texels, int(2u * i))), b = uintBitsToFloat(texelFetch(vertex_texels, int(2u * i + 1u)));
    return VertexRecord(a.xyz, a.w, b.xyz, b.w);
}

// Vertex of a corner: three corners a triangle.
uint triangleIndexAt(uint corner) { return kSceneInStorage ? triangle_indices[corner] : texelFetch(triangle_index_texels, int(corner)).x; }

InstanceRecord instanceAt(uint i) {
    if (kSceneInStorage) return instances[i];
    uvec4 a = texelFetch(instance_texels, int(i));
    return InstanceRecord(a.x, a.y, a.z, a.w);
}

// Fields that the caller does not read are not fetched.
MaterialRecord materialAt(uint i) {
    if (kSceneInStorage) return materials[i];
    int first = int(kMaterialTexels * i);
    vec4 a = uintBitsToFloat(texelFetch(material_texels, first)), b = uintBitsToFloat(texelFetch(material_texels, first + 1));
    vec4 c = uintBitsToFloat(texelFetch(material_texels, first + 2)), d = uintBitsToFloat(texelFetch(material_texels, first + 3));
    uvec4 e = texelFetch(material_texels, first + 4);
    return MaterialRecord(a, b.xyz, b.w, c.xyz, c.w, d.x, d.y, d.z, d.w, e.x, e.y, e.z, e.w);
}

uvec4 materialDetailAt(uint i) { return kSceneInStorage ? material_details[i] : texelFetch(material_detail_texels, int(i)); }

bool hasSlot(MaterialRecord m, uint kind) { return (m.slots & (1u << kind)) != 0u; }
bool hasBlock(MaterialRecord m, uint kind) { return (m.blocks & (1u << kind)) != 0u; }

// How many of a mask's bits stand below that one.
uint bitsBelow(uint mask, uint bit) { return uint(bitCount(mask & ((1u << bit) - 1u))); }

// A slot that is there.
TextureSlotRecord slotAt(MaterialRecord m, uint kind) {
    uint first = m.first_detail + kSlotWords * bitsBelow(m.slots, kind);
    uvec4 a = materialDetailAt(first), b = materialDetailAt(first + 1u);
    return TextureSlotRecord(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), b.w);
}

// A block that is there.
vec4 blockAt(MaterialRecord m, uint kind) {
    return uintBitsToFloat(materialDetailAt(m.first_detail + kSlotWords * uint(bitCount(m.slots)) + bitsBelow(m.blocks, kind)));
}

#endif
