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

// Filtered values of slots, by kind (kSlot...); white where a slot is empty or was not asked for.
struct Texels {
    vec4 of[kSlotCount];
};

const uint kEverySlot = (1u << kSlotCount) - 1u;
const uint kEmissionSlots = (kAlpha ? 1u << kSlotBaseColor : 0u) | 1u << kSlotEmissive | 1u << kSlotClearcoat | 1u << kSlotClearcoatRoughness |
                            1u << kSlotClearcoatNormal;

// By selects: an array that is indexed by a variable lies in memory.
#define LICHT_EMPTY_SLOT(number, name, srgb, words, extension, key) texels.of[number] = vec4(1.0);
#define LICHT_KEEP_TEXEL(number, name, srgb, words, extension, key) \
    if ((kTextureSlotKinds & (1u << number)) != 0u && kind == number) texels.of[number] = texel;

// kinds: bits 1 << kSlot... One loop over the slots that are there, so that the code of a texture is there once: drivers work through all of it before they
// see which slots a scene lacks, and those that run lanes in lockstep take as many rounds as the lane with the most slots.
Texels sampleSlots(MaterialRecord m, uint kinds, uvec3 v, vec3 weights) {
    Texels texels;
    LICHT_TEXTURE_SLOTS(LICHT_EMPTY_SLOT)
    if (kTextures) {
        for (uint left = kinds & kTextureSlotKinds & m.slots; left != 0u; left &= left - 1u) {
            uint kind = uint(findLSB(left));
            vec4 texel = sampleTexture(slotAt(m, kind), v, weights);
            LICHT_TEXTURE_SLOTS(LICHT_KEEP_TEXEL)
        }
    }
    return texels;
}

IridescenceRecord iridescenceOf(MaterialRecord m) {
    vec4 a = blockAt(m, kBlockIridescence);
    return IridescenceRecord(a.x, a.y, a.z, a.w);
}

vec4 baseColorOf(MaterialRecord m, uvec3 v, vec3 weights, Texels texels) {
    vec4 c = m.base_color * texels.of[kSlotBaseColor];
    return kVertexColors ? c * vertexColorAt(v, weights) : c;
}

// Share of rays that meet the surface where the base colour has that alpha.
float coverageOf(MaterialRecord m, float alpha) {
    if ((m.flags & kMaterialAlphaMask) != 0u) return alpha >= m.alpha_cutoff ? 1.0 : 0.0;
    return (m.flags & kMaterialAlphaBlend) != 0u ? min(alpha, 1.0) : 1.0;
}

// A masked or blended surface is there or not, for this ray, as one number of [0,1) decides.
bool passesAlphaTest(uint instance, uint primitive, float b1, float b2, float u) {
    MaterialRecord m = materialAt(instanceAt(instance).material);
    if ((m.flags & (kMaterialAlphaMask | kMaterialAlphaBlend)) == 0u) return true;
    uvec3 v = triangleVertices(instance, primitive);
    vec3 weights = vec3(1.0 - b1 - b2, b1, b2);
    float alpha = baseColorOf(m, v, weights, sampleSlots(m, 1u << kSlotBaseColor, v, weights)).a;
    return u < coverageOf(m, alpha);
}

// Where a material is asked what it emits and scatters.
struct Spot {
    uvec3 vertices;
    vec3 weights;
    Placement placement;
    bool tangents;  // the vertices have them
    bool front;     // wo is where the triangle's front faces
    vec3 normal;    // interpolated, unit, world, on the triangle's front
    vec3 face;      // the triangle's own, unit, world, on the side of wo
    vec3 wo;        // unit, world
};

// glTF's normal map: tangent space of the interpolated normal and the vertices' tangents. k: in [-1,1].
vec3 mappedNormal(vec3 k, float scale, Spot p) {
    uvec3 v = p.vertices;
    vec3 n = p.normal;
    vec4 t = interpolate(p.weights, worldTangent(p.placement, tangents[v.x]), worldTangent(p.placement, tangents[v.y]),
                         worldTangent(p.placement, tangents[v.z]));
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
vec3 shadingNormal(MaterialRecord m, uint kind, Texels texels, float scale, Spot p) {
    vec3 n = p.normal;
    if (kNormalMaps && p.tangents && hasTexture(m, kind)) n = mappedNormal(texels.of[kind].xyz * 2.0 - 1.0, scale, p);
    n = p.front ? n : -n;
    // Keeps wo inside the hemisphere by more than the rounding of the frame. Normalising lengthens n by up to half its square, 5e-7 of it, which is given
    // back beforehand, and more.
    const float kLowestCosine = 1e-3;
    float away = dot(n, p.wo);
    return away < kLowestCosine ? normalize(n + (kLowestCosine - away) * 1.0001 * p.wo) : n;
}

// That normal as mirrors have it: bent towards the face until the mirror image of wo is above it. Where interpolation or the map tilts it further, the surface
// would reflect itself, black because nothing is found below it. Keller et al. 2017, The iray light transport simulation and rendering system; the height
// that is kept above the face is that of Cycles. No energy of a polished surface is lost; reciprocity is, where it is bent, for it depends on wo.
vec3 mirroringNormal(vec3 n, Spot p) {
    vec3 mirrored = 2.0 * dot(n, p.wo) * n - p.wo;
    // Lower than wo, so that a flat surface keeps its normal; and more than rounding, so that what is normalised is there.
    float lowest = clamp(0.9 * dot(p.face, p.wo), 1e-4, 0.01);
    float below = lowest - dot(p.face, mirrored);
    return below > 0.0 ? normalize(p.wo + normalize(mirrored + below * p.face)) : n;
}

// Its normal in the world: the base's normal map has no part in it.
Clearcoat clearcoatOf(MaterialRecord m, Texels texels, Spot p) {
    if (!kClearcoat || !hasBlock(m, kBlockClearcoat)) return kNoClearcoat;
    vec4 a = blockAt(m, kBlockClearcoat);
    ClearcoatRecord c = ClearcoatRecord(a.x, a.y, a.z, a.w);
    float factor = c.factor * texels.of[kSlotClearcoat].r;
    float roughness = c.roughness * texels.of[kSlotClearcoatRoughness].g;
    return Clearcoat(factor, alphaOf(roughness), mirroringNormal(shadingNormal(m, kSlotClearcoatNormal, texels, c.normal_scale, p), p));
}

// Whether a surface may send different light from its points or in different directions.
const bool kUnevenEmission = kTextures || kClearcoat || kAlpha;

// Emitted towards wo, cd/m^2, as far as a clearcoat passes it. Single-sided surfaces emit from their front.
vec3 emissionOf(MaterialRecord m, Texels texels, Spot p, Clearcoat coat) {
    if (!kEmission || !(p.front || (m.flags & kMaterialDoubleSided) != 0u)) return vec3(0.0);
    vec3 emission = m.emission * texels.of[kSlotEmissive].rgb;
    return kClearcoat ? emission * (1.0 - albedoClearcoat(coat, p.wo)) : emission;
}

// frame: around the shading normal, in which the BSDF is local. base: the base colour. coat: in the world.
Bsdf bsdfOf(MaterialRecord m, Texels texels, Frame frame, vec3 base, Clearcoat coat, Spot p) {
    if (!kGlossy) return lambertBsdf(base);
    float metallic = m.metallic * texels.of[kSlotMetallicRoughness].b;
    float roughness = m.roughness * texels.of[kSlotMetallicRoughness].g;
    float specular = m.specular * texels.of[kSlotSpecular].a;
    vec3 specular_color = m.specular_color * texels.of[kSlotSpecularColor].rgb;
    vec3 dielectric_f0 = min(m.dielectric_f0 * specular_color, vec3(1.0)) * specular;
    Bsdf b = Bsdf(Diffuse(base * (1.0 - metallic)), plainSpecular(alphaOf(roughness), dielectric_f0, specular, base, metallic),
                  Clearcoat(coat.factor, coat.alpha, localFromWorld(frame, coat.normal)));
    b.specular.normal = localFromWorld(frame, mirroringNormal(frame.normal, p));
    if (kIridescence && hasBlock(m, kBlockIridescence)) {
        IridescenceRecord iridescence = iridescenceOf(m);
        float thickness = iridescence.thickness_maximum;
        if (hasTexture(m, kSlotIridescenceThickness))
            thickness = mix(iridescence.thickness_minimum, thickness, texels.of[kSlotIridescenceThickness].g);
        b.specular.thin_film = thinFilm(iridescence.factor * texels.of[kSlotIridescence].r, iridescence.ior, thickness);
    }
    return b;
}

#endif
