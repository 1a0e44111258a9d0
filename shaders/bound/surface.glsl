// From a hit to what scatters and emits there. Raster hits and traced hits go through the same code.
#ifndef LICHT_BOUND_SURFACE_GLSL
#define LICHT_BOUND_SURFACE_GLSL

#include "bound/texture.glsl"
#include "pure/bsdf.glsl"
#include "pure/frame.glsl"
#include "pure/random.glsl"
#include "shared/dimensions.h"
#include "shared/geometry.h"
#include "shared/index.h"
#include "shared/material.h"

struct Surface {
    vec3 position;       // world
    float error_bound;   // how far from the true plane position and traversal may see each other, metres
    vec3 face_normal;    // unit, world, on the side of wo
    Frame frame;         // around the shading normal, on the side of wo
    Bsdf bsdf;
    vec3 base_color;
    vec3 emission;       // towards wo, cd/m^2
    uint light;          // in the light table; kNoIndex: found by scattering alone
};

// fp32 rounds the position to a few units in 2^-24 of the vertices' coordinates (PBRT 4, section 6.8.5 has gamma(7)), and the traversal, which
// works relative to the ray's origin, adds about as many of the triangle's own extent. Measured needs are 1 to 8 units.
const float kPositionUnits = 32.0 * 5.9604644775390625e-8;

vec4 baseColorAt(MaterialRecord m, uvec3 v, vec3 weights) {
    vec4 c = m.base_color * sampleSlot(kSlotBaseColor, m.base_color_slot, v, weights);
    return kVertexColors ? c * vertexColorAt(v, weights) : c;
}

// Coverage: a masked or blended surface is there or not, for this ray, as one number decides.
bool covers(uint instance, uint primitive, float b1, float b2, float u) {
    MaterialRecord m = materialAt(instanceAt(instance).material);
    if ((m.flags & (kMaterialAlphaMask | kMaterialAlphaBlend)) == 0u) return true;
    uvec3 v = triangleVertices(instance, primitive);
    float alpha = baseColorAt(m, v, vec3(1.0 - b1 - b2, b1, b2)).a;
    return (m.flags & kMaterialAlphaMask) != 0u ? alpha >= m.alpha_cutoff : u < alpha;
}

float coverageNumber(SampleAddress address, uint rays_before, uint instance, uint triangle) {
    uint key = triangle * 0x9e3779b9u;
    if (kInstances) key ^= placementKey(instance);
    return random4(SampleAddress(address.pixel, address.index, address.seed ^ key), kDimensionAlpha + rays_before).x;
}

// glTF's normal map: tangent space of the interpolated normal and the vertices' tangents.
vec3 mappedNormal(MaterialRecord m, Placement at, uvec3 v, vec3 weights, vec3 n) {
    vec4 t = weights.x * worldTangent(at, tangents[v.x]) + weights.y * worldTangent(at, tangents[v.y]) + weights.z * worldTangent(at, tangents[v.z]);
    vec3 tangent = t.xyz - dot(t.xyz, n) * n;
    float length2 = dot(tangent, tangent);
    if (!(length2 > 0.0)) return n;
    tangent *= inversesqrt(length2);
    vec3 bitangent = (t.w < 0.0 ? -1.0 : 1.0) * cross(n, tangent);
    vec3 k = sampleSlot(kSlotNormal, m.normal_slot, v, weights).xyz * 2.0 - 1.0;
    vec3 mapped = k.x * m.normal_scale * tangent + k.y * m.normal_scale * bitangent + k.z * n;
    float mapped2 = dot(mapped, mapped);
    return mapped2 > 0.0 ? mapped * inversesqrt(mapped2) : n;
}

Bsdf bsdfOf(MaterialRecord m, uvec3 v, vec3 weights, vec3 base) {
    if (!kGlossy) return lambertBsdf(base);
    float metallic = m.metallic;
    float roughness = m.roughness;
    float specular = m.specular;
    vec3 specular_color = m.specular_color;
    if (kTextures) {
        vec4 mr = sampleSlot(kSlotMetallicRoughness, m.metallic_roughness_slot, v, weights);
        metallic *= mr.b;
        roughness *= mr.g;
        specular *= sampleSlot(kSlotSpecular, m.specular_slot, v, weights).a;
        specular_color *= sampleSlot(kSlotSpecularColor, m.specular_color_slot, v, weights).rgb;
    }
    vec3 dielectric_f0 = min(m.dielectric_f0 * specular_color, vec3(1.0)) * specular;
    Bsdf b = plainBsdf(base * (1.0 - metallic), max(roughness * roughness, kMinAlpha), mix(dielectric_f0, base, metallic),
                       mix(specular, 1.0, metallic), largest(dielectric_f0), specular);
    if (kIridescence) {
        float strength = m.iridescence;
        float thickness = m.iridescence_thickness_maximum;
        if (kTextures) {
            strength *= sampleSlot(kSlotIridescence, m.iridescence_slot, v, weights).r;
            if (m.iridescence_thickness_slot.texture != kNoIndex)
                thickness = mix(m.iridescence_thickness_minimum, thickness, sampleSlot(kSlotIridescenceThickness, m.iridescence_thickness_slot, v, weights).g);
        }
        b.film = thinFilm(strength, m.iridescence_ior, thickness);
        b.film_dielectric_f0 = dielectric_f0;
        b.film_metal_f0 = base;
        b.metallic = metallic;
    }
    return b;
}

// A triangle's plane.
struct Face {
    vec3 normal;        // unit, world; the triangle is counter-clockwise seen from where it points to
    float error_bound;  // how far from the true plane position and traversal may see each other, metres
};

// What going to an instance's object space and back adds to the error of positions: seen from the world along the normal n, the ray's origin is off by
// 5 u |n| |M| |M^-1| |P - pivot|, the vertex by 4 u |n| |M| |p|, and the object's own test by 20 u |n| |M| |p| (u = 2^-24; the terms stand with
// kInstanceSlack). With ||M^-1|| |P - pivot| <= condition * |p| in the largest component, kPositionUnits = 32 u of this holds them all.
float instanceError(Placement at, vec3 normal, vec3 p0, vec3 p1, vec3 p2) {
    vec3 row_sums = vec3(dot(abs(at.x), vec3(1.0)), dot(abs(at.y), vec3(1.0)), dot(abs(at.z), vec3(1.0)));
    return at.condition * dot(abs(normal), row_sums) * largest(max(abs(p0), max(abs(p1), abs(p2))));
}

// Of vertices in object space. Edges are taken there, so that far from the world's origin no bits of the normal are lost.
Face faceOf(Placement at, vec3 p0, vec3 p1, vec3 p2) {
    vec3 e1 = worldVector(at, p1 - p0), e2 = worldVector(at, p2 - p0);
    float scale = largest(max(abs(e1), abs(e2)));  // so that the product of tiny edges does not underflow
    vec3 area2 = cross(e1 / scale, e2 / scale);
    float length_area2 = length(area2);
    vec3 normal = area2 / length_area2;
    if (kInstances && at.mirrored) normal = -normal;
    float coordinates = dot(abs(normal), max(abs(worldPoint(at, p0)), max(abs(worldPoint(at, p1)), abs(worldPoint(at, p2)))));
    float error = coordinates + scale;
    if (kInstances) error += instanceError(at, normal, p0, p1, p2);
    return Face(normal, kPositionUnits * error);
}

// Emitted towards wo, cd/m^2. Single-sided surfaces emit from their front.
vec3 emissionOf(MaterialRecord m, uvec3 v, vec3 weights, bool front) {
    if (!kEmission || !(front || (m.flags & kMaterialDoubleSided) != 0u)) return vec3(0.0);
    return m.emission * sampleSlot(kSlotEmissive, m.emissive_slot, v, weights).rgb;
}

// wo: unit, world, towards where the path came from.
Surface surfaceAt(Hit hit, vec3 wo) {
    InstanceRecord instance = instanceAt(hit.instance);
    MaterialRecord m = materialAt(instance.material);
    uvec3 v = triangleVertices(hit.instance, hit.primitive);
    vec3 weights = vec3(1.0 - hit.b1 - hit.b2, hit.b1, hit.b2);
    vec3 p0 = vertexAt(v.x).position, p1 = vertexAt(v.y).position, p2 = vertexAt(v.z).position;
    Placement at = placementOf(hit.instance);

    Surface s;
    s.position = weights.x * worldPoint(at, p0) + weights.y * worldPoint(at, p1) + weights.z * worldPoint(at, p2);
    Face face = faceOf(at, p0, p1, p2);
    bool front = dot(face.normal, wo) >= 0.0;
    s.face_normal = front ? face.normal : -face.normal;
    s.error_bound = face.error_bound;

    // The shading normal, on the same side; bent back into view where interpolation or a map turns it away from wo.
    vec3 n = weights.x * worldNormal(at, vertexAt(v.x).normal) + weights.y * worldNormal(at, vertexAt(v.y).normal) +
             weights.z * worldNormal(at, vertexAt(v.z).normal);
    float n2 = dot(n, n);
    n = n2 > 0.0 ? n * inversesqrt(n2) : face.normal;
    if (kNormalMaps && (instance.flags & kInstanceTangents) != 0u && m.normal_slot.texture != kNoIndex) n = mappedNormal(m, at, v, weights, n);
    n = front ? n : -n;
    const float kLowestCosine = 1e-3;  // keeps wo inside the hemisphere by more than the rounding of the frame
    float away = dot(n, wo);
    if (away < kLowestCosine) n = normalize(n + (kLowestCosine - away) * 1.0001 * wo);
    s.frame = frameFromNormal(n);

    vec4 base = baseColorAt(m, v, weights);
    bool unlit = kUnlit && (m.flags & kMaterialUnlit) != 0u;
    s.base_color = base.rgb;
    s.bsdf = bsdfOf(m, v, weights, base.rgb);
    s.emission = emissionOf(m, v, weights, front);
    s.light = kNoIndex;
    if (kLightTriangles && instance.first_light != kNoIndex && largest(s.emission) > 0.0) s.light = instance.first_light + hit.primitive;
    if (unlit) {
        s.bsdf = lambertBsdf(vec3(0.0));
        s.emission = base.rgb;
    }
    return s;
}

#endif
