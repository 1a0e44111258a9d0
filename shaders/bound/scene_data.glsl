// The scene's records, fetched. Drivers that run lanes in lockstep load storage buffers lane by lane and word by word; a texel buffer hands them four
// words of every lane at once (measured: a third of a sample's time in a simple scene was loads). Where texel buffers are too small for the scene the
// same records are read from storage buffers.
#ifndef LICHT_BOUND_SCENE_DATA_GLSL
#define LICHT_BOUND_SCENE_DATA_GLSL

#include "shared/bindings.h"
#include "shared/constants.h"
#include "shared/geometry.h"
#include "shared/material.h"

layout(constant_id = kConstantSceneInStorage) const bool kSceneInStorage = false;

layout(binding = kBindingVertexTexels) uniform usamplerBuffer vertex_texels;
layout(binding = kBindingTriangleIndexTexels) uniform usamplerBuffer triangle_index_texels;  // R32UI
layout(binding = kBindingInstanceTexels) uniform usamplerBuffer instance_texels;
layout(binding = kBindingMaterialTexels) uniform usamplerBuffer material_texels;
layout(std430, binding = kBindingVertices) readonly buffer Vertices { VertexRecord vertices[]; };
layout(std430, binding = kBindingTriangleIndices) readonly buffer TriangleIndices { uint triangle_indices[]; };
layout(std430, binding = kBindingInstances) readonly buffer Instances { InstanceRecord instances[]; };
layout(std430, binding = kBindingMaterials) readonly buffer Materials { MaterialRecord materials[]; };

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

TextureSlotRecord materialSlotAt(int texel) {
    uvec4 a = texelFetch(material_texels, texel), b = texelFetch(material_texels, texel + 1);
    return TextureSlotRecord(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), b.w);
}

// Fields that the caller does not read are not fetched.
MaterialRecord materialAt(uint i) {
    if (kSceneInStorage) return materials[i];
    int first = int(kMaterialTexels * i);
    vec4 a = uintBitsToFloat(texelFetch(material_texels, first)), b = uintBitsToFloat(texelFetch(material_texels, first + 1));
    vec4 c = uintBitsToFloat(texelFetch(material_texels, first + 2)), d = uintBitsToFloat(texelFetch(material_texels, first + 3));
    uvec4 e = texelFetch(material_texels, first + 4);
    float thickest = uintBitsToFloat(texelFetch(material_texels, first + 5).x);
    return MaterialRecord(a, b.xyz, b.w, c.xyz, c.w, d.x, d.y, d.z, d.w, e.x, uintBitsToFloat(e.y), uintBitsToFloat(e.z), uintBitsToFloat(e.w), thickest, 0u,
                          0u, 0u, materialSlotAt(first + 6), materialSlotAt(first + 8), materialSlotAt(first + 10), materialSlotAt(first + 12),
                          materialSlotAt(first + 14), materialSlotAt(first + 16), materialSlotAt(first + 18), materialSlotAt(first + 20));
}

#endif
