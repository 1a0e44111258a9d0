// The scene's buffers, and which effects are compiled in. The binding's name is the resource's name on the host.
#ifndef LICHT_BOUND_SCENE_GLSL
#define LICHT_BOUND_SCENE_GLSL

#include "bound/instances.glsl"
#include "bound/scene_data.glsl"
#include "pure/interpolate.glsl"
#include "shared/effects.h"
#include "shared/bindings.h"
#include "shared/frame.h"
#include "shared/index.h"

layout(constant_id = kEffectTextures) const bool kTextures = true;
layout(constant_id = kEffectNormalMaps) const bool kNormalMaps = true;
layout(constant_id = kEffectVertexColors) const bool kVertexColors = true;
layout(constant_id = kEffectExtraUvSets) const bool kExtraUvSets = true;
layout(constant_id = kEffectAlpha) const bool kAlpha = true;
// kGlossy belongs to pure/bsdf.glsl, kIridescence to pure/lobe/specular.glsl.
layout(constant_id = kEffectEmission) const bool kEmission = true;
layout(constant_id = kEffectLightTriangles) const bool kLightTriangles = true;
layout(constant_id = kEffectPunctualLights) const bool kPunctualLights = true;
layout(constant_id = kEffectEnvironment) const bool kEnvironment = true;
layout(constant_id = kEffectUnlit) const bool kUnlit = true;
layout(constant_id = kEffectSuns) const bool kSuns = true;

// A storage buffer, though a uniform one would hold it: Mesa 22.3's lavapipe writes the values of uniforms that decide branches and loops into the
// program and compiles it again at every submission (measured: 10 s a sample for a textured scene).
layout(std430, binding = kBindingFrame) readonly buffer FrameBlock { FrameRecord frame; };
layout(std430, binding = kBindingTangents) readonly buffer Tangents { vec4 tangents[]; };
layout(std430, binding = kBindingColors) readonly buffer Colors { vec4 colors[]; };
layout(std430, binding = kBindingExtraUvs) readonly buffer ExtraUvs { vec2 extra_uvs[]; };

// Where a path meets the scene; raster and ray deliver the same record. Weights: 1 - b1 - b2, b1, b2.
struct Hit {
    uint instance;  // kNoIndex: nothing
    uint primitive;
    float b1;
    float b2;
};

const Hit kNoHit = Hit(kNoIndex, 0u, 0.0, 0.0);

uvec3 triangleVertices(uint instance, uint primitive) {
    uint first = 3u * (instanceAt(instance).first_triangle + primitive);
    return uvec3(triangleIndexAt(first), triangleIndexAt(first + 1u), triangleIndexAt(first + 2u));
}

vec2 uvAt(uvec3 v, vec3 weights, uint set) {
    if (kExtraUvSets && set > 0u) {
        if (set > frame.extra_uv_sets) return vec2(0.0);
        uvec3 at = v * frame.extra_uv_sets + (set - 1u);
        return interpolate(weights, extra_uvs[at.x], extra_uvs[at.y], extra_uvs[at.z]);
    }
    VertexRecord a = vertexAt(v.x), b = vertexAt(v.y), c = vertexAt(v.z);
    return interpolate(weights, vec2(a.u, a.v), vec2(b.u, b.v), vec2(c.u, c.v));
}

vec4 vertexColorAt(uvec3 v, vec3 weights) {
    if (!kVertexColors) return vec4(1.0);
    return interpolate(weights, colors[v.x], colors[v.y], colors[v.z]);
}

#endif
