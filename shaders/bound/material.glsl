// What a material is at a point: the only file that reads its texture slots and blocks.
#ifndef LICHT_BOUND_MATERIAL_GLSL
#define LICHT_BOUND_MATERIAL_GLSL

#include "bound/texture.glsl"
#include "pure/bsdf.glsl"
#include "pure/frame.glsl"
#include "shared/constants.h"
#include "shared/material.h"
#include "shared/slots.h"

layout(constant_id = kConstantTextureSlotKinds) const uint kTextureSlotKinds = 0xffffffffu;  // bits 1 << kSlot...

bool hasTexture(MaterialRecord m, uint kind) { return kTextures && (kTextureSlotKinds & (1u << kind)) != 0u && hasSlot(m, kind); }

// Filtered value of a slot of that kind (kSlot...); white where it is empty.
vec4 sampleSlot(MaterialRecord m, uint kind, uvec3 v, vec3 weights) {
    return hasTexture(m, kind) ? sampleTexture(slotAt(m, kind), v, weights) : vec4(1.0);
}

IridescenceRecord iridescenceOf(MaterialRecord m) {
    vec4 a = blockAt(m, kBlockIridescence);
    return IridescenceRecord(a.x, a.y, a.z, a.w);
}

vec4 baseColorAt(MaterialRecord m, uvec3 v, vec3 weights) {
    vec4 c = m.base_color * sampleSlot(m, kSlotBaseColor, v, weights);
    return kVertexColors ? c * vertexColorAt(v, weights) : c;
}

// Coverage: a masked or blended surface is there or not, for this ray, as one number decides.
bool passesAlphaTest(uint instance, uint primitive, float b1, float b2, float u) {
    MaterialRecord m = materialAt(instanceAt(instance).material);
    if ((m.flags & (kMaterialAlphaMask | kMaterialAlphaBlend)) == 0u) return true;
    uvec3 v = triangleVertices(instance, primitive);
    float alpha = baseColorAt(m, v, vec3(1.0 - b1 - b2, b1, b2)).a;
    return (m.flags & kMaterialAlphaMask) != 0u ? alpha >= m.alpha_cutoff : u < alpha;
}

// Where a material is asked what it emits and scatters.
struct Spot {
    uvec3 vertices;
    vec3 weights;
    Placement placement;
    bool tangents;  // the vertices have them
    bool front;     // wo is where the triangle's front faces
    vec3 normal;    // interpolated, unit, world, on the triangle's front
    vec3 wo;        // unit, world
};

// glTF's normal map: tangent space of the interpolated normal and the vertices' tangents. k: in [-1,1].
vec3 mappedNormal(vec3 k, float scale, Spot p) {
    uvec3 v = p.vertices;
    vec3 n = p.normal;
    vec4 t = p.weights.x * worldTangent(p.placement, tangents[v.x]) + p.weights.y * worldTangent(p.placement, tangents[v.y]) +
             p.weights.z * worldTangent(p.placement, tangents[v.z]);
    vec3 tangent = t.xyz - dot(t.xyz, n) * n;
    float length2 = dot(tangent, tangent);
    if (!(length2 > 0.0)) return n;
    tangent *= inversesqrt(length2);
    vec3 bitangent = (t.w < 0.0 ? -1.0 : 1.0) * cross(n, tangent);
    vec3 mapped = k.x * scale * tangent + k.y * scale * bitangent + k.z * n;
    float mapped2 = dot(mapped, mapped);
    return mapped2 > 0.0 ? mapped * inversesqrt(mapped2) : n;
}

// The normal by what the map in that slot has there, unit, world, on the side of wo; bent back into view where interpolation or the map turns it away from wo.
vec3 shadingNormal(MaterialRecord m, uint kind, vec4 texel, float scale, Spot p) {
    vec3 n = p.normal;
    if (kNormalMaps && p.tangents && hasTexture(m, kind)) n = mappedNormal(texel.xyz * 2.0 - 1.0, scale, p);
    n = p.front ? n : -n;
    // Keeps wo inside the hemisphere by more than the rounding of the frame. Normalising lengthens n by up to half its square, 5e-7 of it, which is given
    // back beforehand, and more.
    const float kLowestCosine = 1e-3;
    float away = dot(n, p.wo);
    return away < kLowestCosine ? normalize(n + (kLowestCosine - away) * 1.0001 * p.wo) : n;
}

// Its normal in the world: the base's normal map has no part in it.
Clearcoat clearcoatOf(MaterialRecord m, Spot p) {
    if (!kClearcoat || !hasBlock(m, kBlockClearcoat)) return kNoClearcoat;
    vec4 a = blockAt(m, kBlockClearcoat);
    ClearcoatRecord c = ClearcoatRecord(a.x, a.y, a.z, a.w);
    vec3 normal = p.normal;
    // A loop, so that the code of a texture is there once and not three times: drivers work through all of it before they see that a scene has no clearcoat.
    for (uint kind = kSlotClearcoat; kind <= kSlotClearcoatNormal; ++kind) {
        vec4 texel = sampleSlot(m, kind, p.vertices, p.weights);
        if (kind == kSlotClearcoat) c.factor *= texel.r;
        if (kind == kSlotClearcoatRoughness) c.roughness *= texel.g;
        if (kind == kSlotClearcoatNormal) normal = shadingNormal(m, kind, texel, c.normal_scale, p);
    }
    return Clearcoat(c.factor, alphaOf(c.roughness), normal);
}

// Whether a surface may send different light from its points or in different directions.
const bool kUnevenEmission = kTextures || kClearcoat;

// Emitted towards wo, cd/m^2, as far as a clearcoat passes it. Single-sided surfaces emit from their front.
vec3 emissionOf(MaterialRecord m, Spot p, Clearcoat coat) {
    if (!kEmission || !(p.front || (m.flags & kMaterialDoubleSided) != 0u)) return vec3(0.0);
    vec3 emission = m.emission * sampleSlot(m, kSlotEmissive, p.vertices, p.weights).rgb;
    return kClearcoat ? emission * (1.0 - albedoClearcoat(coat, p.wo)) : emission;
}

// frame: around the shading normal, in which the BSDF is local. base: the base colour. coat: in the world.
Bsdf bsdfOf(MaterialRecord m, Spot p, Frame frame, vec3 base, Clearcoat coat) {
    if (!kGlossy) return lambertBsdf(base);
    uvec3 v = p.vertices;
    vec3 weights = p.weights;
    float metallic = m.metallic;
    float roughness = m.roughness;
    float specular = m.specular;
    vec3 specular_color = m.specular_color;
    if (kTextures) {
        vec4 mr = sampleSlot(m, kSlotMetallicRoughness, v, weights);
        metallic *= mr.b;
        roughness *= mr.g;
        specular *= sampleSlot(m, kSlotSpecular, v, weights).a;
        specular_color *= sampleSlot(m, kSlotSpecularColor, v, weights).rgb;
    }
    vec3 dielectric_f0 = min(m.dielectric_f0 * specular_color, vec3(1.0)) * specular;
    Bsdf b = Bsdf(Diffuse(base * (1.0 - metallic)), plainSpecular(alphaOf(roughness), mix(dielectric_f0, base, metallic), mix(specular, 1.0, metallic),
                                                                  largest(dielectric_f0), specular),
                  Clearcoat(coat.factor, coat.alpha, localFromWorld(frame, coat.normal)));
    if (kIridescence && hasBlock(m, kBlockIridescence)) {
        IridescenceRecord iridescence = iridescenceOf(m);
        float thickness = iridescence.thickness_maximum;
        if (hasTexture(m, kSlotIridescenceThickness))
            thickness = mix(iridescence.thickness_minimum, thickness, sampleSlot(m, kSlotIridescenceThickness, v, weights).g);
        b.specular.thin_film = thinFilm(iridescence.factor * sampleSlot(m, kSlotIridescence, v, weights).r, iridescence.ior, thickness);
        b.specular.film_dielectric_f0 = dielectric_f0;
        b.specular.film_metal_f0 = base;
        b.specular.metallic = metallic;
    }
    return b;
}

#endif
