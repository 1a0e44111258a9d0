// From a hit to what scatters and emits there. Raster hits and traced hits go through the same code.
#ifndef LICHT_BOUND_SURFACE_GLSL
#define LICHT_BOUND_SURFACE_GLSL

#include "bound/material.glsl"
#include "pure/frame.glsl"
#include "pure/random.glsl"
#include "shared/dimensions.h"
#include "shared/geometry.h"
#include "shared/index.h"

struct Surface {
    vec3 position;       // world
    float error_bound;   // how far from the true plane position and traversal may see each other, metres
    vec3 face_normal;    // unit, world, on the side of wo
    bool front;          // wo is where the triangle's front faces
    Frame frame;         // around the shading normal, on the side of wo
    Bsdf bsdf;
    vec3 base_color;
    vec3 emission;       // towards wo, cd/m^2
    bool unlit;          // shows its colour to the camera and gives no light
    uint light;          // in the light table; kNoIndex: found by scattering alone
};

// fp32 rounds the position to a few units in 2^-24 of the vertices' coordinates (PBRT 4, section 6.8.5 has gamma(7)), and the traversal, which
// works relative to the ray's origin, adds about as many of the triangle's own extent. Measured needs are 1 to 8 units.
const float kPositionUnits = 32.0 * 5.9604644775390625e-8;

float coverageNumber(SampleAddress address, uint ray, uint instance, uint triangle) {
    uint key = triangle * 0x9e3779b9u;
    if (kInstances) key ^= placementKey(instance);
    return random4(SampleAddress(address.pixel, address.index, address.seed ^ key), kDimensionCoverage + ray).x;
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

// face_normal: of the triangle's front.
Spot spotAt(InstanceRecord instance, uvec3 v, vec3 weights, Placement at, vec3 face_normal, bool front, vec3 wo) {
    vec3 n = interpolate(weights, worldNormal(at, vertexAt(v.x).normal), worldNormal(at, vertexAt(v.y).normal), worldNormal(at, vertexAt(v.z).normal));
    float n2 = dot(n, n);
    return Spot(v, weights, at, (instance.flags & kInstanceTangents) != 0u, front, n2 > 0.0 ? n * inversesqrt(n2) : face_normal,
                front ? face_normal : -face_normal, wo);
}

// What a triangle that is no place of a hit emits, a point of a light, to all rays on average: by its coverage. face_normal: unit, of its front.
// wo: unit, world.
vec3 emissionAt(uint instance_index, uint primitive, vec3 weights, vec3 face_normal, bool front, vec3 wo) {
    InstanceRecord instance = instanceAt(instance_index);
    uvec3 v = triangleVertices(instance_index, primitive);
    MaterialRecord m = materialAt(instance.material);
    Spot spot = spotAt(instance, v, weights, placementOf(instance_index), face_normal, front, wo);
    Texels texels = sampleSlots(m, kEmissionSlots, v, weights);
    vec3 emission = emissionOf(m, texels, spot, clearcoatOf(m, texels, spot));
    return kAlpha ? emission * coverageOf(m, baseColorOf(m, v, weights, texels).a) : emission;
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
    s.position = interpolate(weights, worldPoint(at, p0), worldPoint(at, p1), worldPoint(at, p2));
    Face face = faceOf(at, p0, p1, p2);
    s.front = dot(face.normal, wo) >= 0.0;
    s.face_normal = s.front ? face.normal : -face.normal;
    s.error_bound = face.error_bound;

    Texels texels = sampleSlots(m, kEverySlot, v, weights);
    Spot spot = spotAt(instance, v, weights, at, face.normal, s.front, wo);
    s.frame = frameFromNormal(shadingNormal(m, kSlotNormal, texels, m.normal_scale, spot));

    vec4 base = baseColorOf(m, v, weights, texels);
    s.unlit = kUnlit && (m.flags & kMaterialUnlit) != 0u;
    s.base_color = base.rgb;
    Clearcoat coat = clearcoatOf(m, texels, spot);
    s.bsdf = bsdfOf(m, texels, s.frame, base.rgb, coat, spot);
    s.emission = emissionOf(m, texels, spot, coat);
    s.light = kNoIndex;
    if (kLightTriangles && instance.first_light != kNoIndex && largest(s.emission) > 0.0) s.light = instance.first_light + hit.primitive;
    if (s.unlit) {
        s.bsdf = lambertBsdf(vec3(0.0));
        s.emission = base.rgb;
    }
    return s;
}

#endif
