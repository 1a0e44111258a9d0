// The lights: emissive triangles, rectangles and round meshes, punctual lights and the environment. Three verbs: sample a light as seen from a point,
// its density for a hit that scattering found, and what it sends.
#ifndef LICHT_BOUND_LIGHT_GLSL
#define LICHT_BOUND_LIGHT_GLSL

#include "bound/environment.glsl"
#include "bound/light_tree.glsl"
#include "bound/visibility.glsl"
#include "pure/spherical.glsl"
#include "shared/bindings.h"
#include "shared/choices.h"
#include "shared/constants.h"
#include "shared/dimensions.h"
#include "shared/index.h"
#include "shared/light.h"

layout(constant_id = kConstantLights) const uint kLights = kLightsPower;

layout(binding = kBindingLightTexels) uniform usamplerBuffer light_texels;
layout(binding = kBindingLightAliasTexels) uniform usamplerBuffer light_alias_texels;
layout(std430, binding = kBindingLights) readonly buffer Lights { LightRecord lights[]; };
layout(std430, binding = kBindingLightAlias) readonly buffer LightAlias { AliasRecord light_alias[]; };

LightRecord lightAt(uint i) {
    if (kSceneInStorage) return lights[i];
    int first = int(kLightTexels * i);
    vec4 a = uintBitsToFloat(texelFetch(light_texels, first)), b = uintBitsToFloat(texelFetch(light_texels, first + 1));
    vec4 c = uintBitsToFloat(texelFetch(light_texels, first + 2)), d = uintBitsToFloat(texelFetch(light_texels, first + 3));
    uvec4 e = texelFetch(light_texels, first + 4);
    return LightRecord(a.xyz, floatBitsToUint(a.w), b.xyz, b.w, c.xyz, c.w, d.xyz, d.w, e.x, e.y, uintBitsToFloat(e.z), e.w);
}

AliasRecord lightAliasAt(uint i) {
    if (kSceneInStorage) return light_alias[i];
    uvec4 a = texelFetch(light_alias_texels, int(i));
    return AliasRecord(uintBitsToFloat(a.x), a.y, uintBitsToFloat(a.z), a.w);
}

struct LightSample {
    vec3 direction;   // world; its length times t_max reaches the light
    float t_max;      // for the shadow ray
    vec3 radiance;    // towards the surface; for punctual lights irradiance on a facing surface
    float pdf;        // solid angle, with the probability of the pick; of punctual lights the pick alone
    bool delta;       // scattering cannot find it
    bool valid;
    uint target;      // see ShadowRay
    float t_enough;   // what is met nearer than that is surely not the target
    uint tries;       // of rejection; 0: it was not asked
};

const LightSample kNoLight = LightSample(vec3(0.0), 0.0, vec3(0.0), 0.0, false, false, kNoIndex, 0.0, 0u);

// Lights are chosen by what surfaces reflect where, too.
const bool kHeedsGloss = kGlossy && kLights == kLightsTree;

// Who asks for lights: the choice among them depends on where the surface is, whither it faces and what it reflects where. Packed, so that a path
// can carry it; picking and looking up both read it from here.
struct LightAsker {
    vec3 position;  // world
    uint normal;    // shading normal
    uint wo;
    uint gloss;     // two halves: GGX width; coat over base
};

const LightAsker kNobody = LightAsker(vec3(0.0), 0u, 0u, 0u);

// wo: world, unit.
LightAsker askerAt(Surface s, vec3 wo) {
    LightAsker asker = LightAsker(s.position, packOctahedral(s.frame.normal), 0u, 0u);
    if (kHeedsGloss) {
        float cos_o = dot(wo, s.frame.normal);
        asker.wo = packOctahedral(wo);
        asker.gloss = cos_o > 0.0 ? packHalf2x16(glossTowards(s.bsdf, cos_o)) : 0u;
    }
    return asker;
}

Receiver receiverOf(LightAsker asker) {
    vec2 gloss = unpackHalf2x16(asker.gloss);
    return Receiver(asker.position, unpackOctahedral(asker.normal), unpackOctahedral(asker.wo), gloss.x, gloss.y);
}

struct LightPick {
    uint light;  // kNoIndex: none
    float pmf;
};

// A column of the alias table; the first one may stand for the tree.
LightPick pickLight(LightAsker asker, vec2 u) {
    float at = u.x * float(frame.light_slots);
    uint slot = min(uint(at), frame.light_slots - 1u);
    AliasRecord column = lightAliasAt(slot);
    bool keep = u.y < column.threshold;
    if (!keep) slot = column.alias;
    if (kLights != kLightsTree) return LightPick(slot, 0.0);
    if (slot > 0u) return LightPick(frame.tree_lights + slot - 1u, 1.0);
    // What the two numbers have not yet decided is uniform again.
    float rest = keep ? u.y / column.threshold : (u.y - column.threshold) / (1.0 - column.threshold);
    TreePick pick = pickInTree(receiverOf(asker), vec2(fract(at), min(rest, 0.99999994)));
    return LightPick(pick.light, pick.pmf);
}

// Probability of picking light `index` from there.
float pmfOfLight(LightRecord light, uint index, LightAsker asker) {
    if (kLights != kLightsTree || index >= frame.tree_lights || light.pmf <= 0.0) return light.pmf;
    return light.pmf * pmfInTree(receiverOf(asker), light.trail);
}

uint kindOf(LightRecord light) { return light.kind & kLightKindMask; }

// Solid angle of a triangle or rectangle, where sampling by it is sound; 0 where the area is sampled instead. Sampling and looking up ask alike.
float sampledSolidAngle(LightRecord light, vec3 from) {
    vec3 corner = light.position - from;
    float omega = kindOf(light) == kLightRectangle ? solidAngleRectangle(corner, light.direction, light.intensity)
                                                   : solidAngleTriangle(corner, corner + light.direction, corner + light.intensity);
    return omega > kSmallestSolidAngle && omega < kLargestSolidAngle ? omega : 0.0;
}

// Twice the area of a triangle, the area of a rectangle, along the normal.
vec3 areaVector(LightRecord light) { return cross(light.direction, light.intensity); }

// Density of the point at `d` from the asker, by solid angle, once the light is picked. d2: |d|^2.
float pdfOnShape(LightRecord light, float omega, vec3 d, float d2) {
    if (omega > 0.0) return 1.0 / omega;
    // Area to solid angle: r^2 / (A cos) = r^3 / |A . d|.
    float projected = abs(dot(areaVector(light), d)) * (kindOf(light) == kLightRectangle ? 1.0 : 0.5);
    return d2 * sqrt(d2) / projected;
}

// A round mesh fills part of the cone of directions to the sphere around it. All of the cone is sampled, alike, and a ray that meets something else
// first or passes by the mesh brings nothing. Inside the sphere it is not sampled: more than half of all directions may end at it, and scattering finds
// them. The square of the sine of the cone's half angle; 1 or more: inside. to_centre2: squared distance of the centre.
float sine2OfSphere(LightRecord light, float to_centre2) { return light.range * light.range / to_centre2; }

float pdfOnSphere(float sine2) { return sine2 < 1.0 ? 1.0 / solidAngleCone(sine2) : 0.0; }

// Density, by solid angle, with which light sampling at `asker` would have found the emitting point `s`; 0: never.
float pdfOfSurface(Surface s, LightAsker asker) {
    if (!kLightTriangles || s.light == kNoIndex) return 0.0;
    LightRecord light = lightAt(s.light);
    if (kLightSpheres && kindOf(light) == kLightSphere) {
        vec3 centre = light.position - asker.position;
        return pmfOfLight(light, s.light, asker) * pdfOnSphere(sine2OfSphere(light, dot(centre, centre)));
    }
    vec3 d = s.position - asker.position;
    return pmfOfLight(light, s.light, asker) * pdfOnShape(light, sampledSolidAngle(light, asker.position), d, dot(d, d));
}

float pdfOfSky(vec3 direction) {
    return frame.environment_light == kNoIndex ? 0.0 : lightAt(frame.environment_light).pmf * pdfEnvironment(direction);
}

// A directional light that fills a cone of directions, called a sun, sends E over them: radiance E / (pi sin^2), so that a surface that faces it gets E.
vec3 radianceOfSun(LightRecord sun) { return sun.intensity / (kPi * sun.cone_scale); }

// Density of each of its directions.
float pdfOfSun(LightRecord sun) { return sun.pmf / solidAngleCone(sun.cone_scale); }

bool isInSun(LightRecord sun, vec3 direction) { return insideCone(-sun.direction, sun.cone_scale, direction); }

// What the light emits at a point of its plane towards wo, seen from the front or the back.
vec3 shapeEmission(LightRecord light, vec3 point, bool front, vec3 wo) {
    if (!front && (light.kind & kLightDoubleSided) == 0u) return vec3(0.0);
    if (!kUnevenEmission || (light.kind & kLightUneven) == 0u) return light.emission;
    vec3 n = areaVector(light);
    vec3 at = point - light.position;
    float inverse = 1.0 / dot(n, n);
    vec2 b = clamp(vec2(dot(cross(at, light.intensity), n), dot(cross(light.direction, at), n)) * inverse, 0.0, 1.0);
    return emissionAt(light.instance, light.primitive, vec3(1.0 - b.x - b.y, b), normalize(n), front, wo);
}

LightSample sampleShape(LightRecord light, float pmf, Surface from, vec2 u) {
    bool rectangle = kindOf(light) == kLightRectangle;
    vec3 corner = light.position - from.position;
    vec3 area = areaVector(light);
    float omega = sampledSolidAngle(light, from.position);
    vec3 d;
    if (omega > 0.0) {
        if (rectangle) {
            d = sampleRectangleSolidAngle(corner, light.direction, light.intensity, u);
        } else {
            vec3 w = sampleTriangleSolidAngle(corner, corner + light.direction, corner + light.intensity, u);
            d = w * (dot(corner, area) / dot(w, area));
        }
    } else {
        vec2 b = rectangle ? u : sampleTriangle(u);
        d = corner + b.x * light.direction + b.y * light.intensity;
    }
    float d2 = dot(d, d);
    vec3 radiance = shapeEmission(light, from.position + d, dot(area, d) < 0.0, -normalize(d));
    float pdf = pmf * pdfOnShape(light, omega, d, d2);
    bool valid = d2 > 0.0 && largest(radiance) > 0.0 && pdf > 0.0 && !isinf(pdf);
    // The ray ends before the light's plane by as much as both may be off.
    vec3 normal = area * inversesqrt(dot(area, area));
    vec3 extent = abs(light.position) + abs(light.direction) + abs(light.intensity);
    float error_bound = kPositionUnits * (dot(abs(normal), extent) + largest(max(abs(light.direction), abs(light.intensity))));
    vec3 target = offsetOrigin(from.position + d, normal, error_bound, -d);
    return LightSample(target - offsetOrigin(from, d), 1.0, radiance, pdf, false, valid, kNoIndex, infinity(), 0u);
}

// The mesh is closed and faces outwards (emitter_shapes.cpp), so what a ray meets first of it is a front.
LightSample sampleSphere(LightRecord light, float pmf, Surface from, vec2 u) {
    vec3 centre = light.position - from.position;
    float d2 = dot(centre, centre);
    float sine2 = sine2OfSphere(light, d2);
    if (!(sine2 < 1.0)) return kNoLight;
    float inverse = inversesqrt(d2), distance = d2 * inverse;
    Frame to_centre = frameFromNormal(centre * inverse);
    vec3 w = sampleCone(sine2, u);
    // The ray goes through the middle of the chord, seen from the centre, so that small and far spheres are not missed by rounding. The mesh is within a
    // radius of that.
    vec3 middle = centre + worldFromLocal(to_centre, distance * vec3(w.z * w.xy, -dot(w.xy, w.xy)));
    float along = distance * w.z;
    float end = along + light.range;
    vec3 direction = middle + (from.position - offsetOrigin(from, middle));
    float pdf = pmf * pdfOnSphere(sine2);
    bool valid = along > 0.0 && pdf > 0.0 && !isinf(pdf);
    return LightSample(direction * (end / along), 1.0, light.emission, pdf, false, valid, light.instance, (along - light.range) / end, 0u);
}

// Never in the tree: its own probability is all.
LightSample sampleDirectional(LightRecord light, vec2 u) {
    if (!kSuns || light.cone_scale <= 0.0)
        return LightSample(-light.direction, infinity(), light.intensity, light.pmf, true, true, kNoIndex, infinity(), 0u);
    vec3 direction = worldFromLocal(frameFromNormal(-light.direction), sampleCone(light.cone_scale, u));
    return LightSample(direction, infinity(), radianceOfSun(light), pdfOfSun(light), false, true, kNoIndex, infinity(), 0u);
}

// KHR_lights_punctual: inverse square, an optional range window, and a spot's cone.
LightSample samplePunctualLight(LightRecord light, float pmf, Surface from) {
    vec3 to_light = light.position - from.position;
    float distance2 = dot(to_light, to_light);
    if (!(distance2 > 0.0)) return kNoLight;
    vec3 direction = to_light * inversesqrt(distance2);
    vec3 irradiance = light.intensity / distance2;
    if (light.range > 0.0) {
        float x = distance2 / (light.range * light.range);
        irradiance *= clamp(1.0 - x * x, 0.0, 1.0);
    }
    if (kindOf(light) == kLightSpot) {
        float cone = clamp(dot(light.direction, -direction) * light.cone_scale + light.cone_offset, 0.0, 1.0);
        irradiance *= cone * cone;
    }
    if (largest(irradiance) <= 0.0) return kNoLight;
    return LightSample(light.position - offsetOrigin(from, direction), 1.0, irradiance, pmf, true, true, kNoIndex, infinity(), 0u);
}

LightSample sampleLight(Surface from, LightAsker asker, SampleAddress address, uint dimension) {
    if (frame.light_slots == 0u) return kNoLight;
    vec4 u = sample4(address, dimension + kDimensionLight);  // xy: where on the light; zw: which one
    LightPick pick = pickLight(asker, u.zw);
    if (pick.light == kNoIndex) return kNoLight;
    LightRecord light = lightAt(pick.light);
    float pmf = kLights == kLightsTree ? light.pmf * pick.pmf : light.pmf;
    uint kind = kindOf(light);
    if (kLightTriangles && (kind == kLightTriangle || kind == kLightRectangle)) return sampleShape(light, pmf, from, u.xy);
    if (kLightSpheres && kind == kLightSphere) return sampleSphere(light, pmf, from, u.xy);
    if (kEnvironment && kind == kLightEnvironment) {
        EnvironmentSample e = sampleEnvironment(sampleBits4(address, dimension + kDimensionEnvironment));
        return LightSample(e.direction, infinity(), environmentRadiance(e.direction), pmf * e.pdf, false, e.pdf > 0.0, kNoIndex, infinity(), e.tries);
    }
    if (kPunctualLights && kind == kLightDirectional) return sampleDirectional(light, u.xy);
    if (kPunctualLights) return samplePunctualLight(light, pmf, from);
    return kNoLight;
}

#endif
