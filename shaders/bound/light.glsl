// The light table: emissive triangles, punctual lights and the environment, one of them picked by an alias table.
// Three verbs: sample a light as seen from a point, its density for a hit that scattering found, and what it sends.
#ifndef LICHT_BOUND_LIGHT_GLSL
#define LICHT_BOUND_LIGHT_GLSL

#include "bound/environment.glsl"
#include "bound/visibility.glsl"

layout(binding = 54) uniform usamplerBuffer light_texels;
layout(binding = 55) uniform usamplerBuffer light_alias_texels;
layout(std430, binding = 5) readonly buffer Lights { LightRecord lights[]; };
layout(std430, binding = 6) readonly buffer LightAlias { AliasRecord light_alias[]; };

LightRecord lightAt(uint i) {
    if (kSceneInStorage) return lights[i];
    int first = int(4u * i);
    vec4 b = uintBitsToFloat(texelFetch(light_texels, first + 1)), c = uintBitsToFloat(texelFetch(light_texels, first + 2));
    uvec4 a = texelFetch(light_texels, first), d = texelFetch(light_texels, first + 3);
    return LightRecord(uintBitsToFloat(a.xyz), a.w, b.xyz, b.w, c.xyz, c.w, d.x, d.y, uintBitsToFloat(d.z), uintBitsToFloat(d.w));
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
};

const LightSample kNoLight = LightSample(vec3(0.0), 0.0, vec3(0.0), 0.0, false, false);

uint pickLight(vec2 u) {
    uint i = min(uint(u.x * float(frame.light_count)), frame.light_count - 1u);
    return u.y < lightAliasAt(i).threshold ? i : lightAliasAt(i).alias;
}

// Density of hitting a triangle light at `s` from `distance2` away (squared metres), by solid angle: pmf / area * r^2 / cos.
float pdfTriangleLight(Surface s, float distance2, vec3 direction_to_light) {
    float cos_light = abs(dot(s.face_normal, direction_to_light));
    return lightAt(s.light).pmf * distance2 / (s.area * cos_light);
}

LightSample sampleTriangleLight(LightRecord light, Surface from, vec2 u) {
    vec2 b = sampleTriangle(u);
    vec3 weights = vec3(1.0 - b.x - b.y, b);
    uvec3 v = triangleVertices(light.instance, light.primitive);
    vec3 p0 = vertexAt(v.x).position, p1 = vertexAt(v.y).position, p2 = vertexAt(v.z).position;
    vec3 position = weights.x * p0 + weights.y * p1 + weights.z * p2;
    vec3 to_light = position - from.position;
    float distance2 = dot(to_light, to_light);
    vec3 direction = to_light * inversesqrt(distance2);
    Face face = faceOf(kBaked, p0, p1, p2);  // what emits is never instanced
    float cos_light = -dot(face.normal, direction);
    vec3 radiance = emissionOf(materialAt(instanceAt(light.instance).material), v, weights, cos_light > 0.0);
    float pdf = light.pmf * distance2 / (face.area * abs(cos_light));
    bool valid = distance2 > 0.0 && largest(radiance) > 0.0 && pdf > 0.0 && !isinf(pdf);
    vec3 target = offsetOrigin(position, face.normal, face.error_bound, -direction);
    return LightSample(target - offsetOrigin(from, direction), 1.0, radiance, pdf, false, valid);
}

// KHR_lights_punctual: inverse square, an optional range window, and a spot's cone.
LightSample samplePunctualLight(LightRecord light, Surface from) {
    if (light.kind == kLightDirectional)
        return LightSample(-light.direction, uintBitsToFloat(0x7f800000u), light.intensity, light.pmf, true, true);
    vec3 to_light = light.position - from.position;
    float distance2 = dot(to_light, to_light);
    if (!(distance2 > 0.0)) return kNoLight;
    vec3 direction = to_light * inversesqrt(distance2);
    vec3 irradiance = light.intensity / distance2;
    if (light.range > 0.0) {
        float x = distance2 / (light.range * light.range);
        irradiance *= clamp(1.0 - x * x, 0.0, 1.0);
    }
    if (light.kind == kLightSpot) {
        float cone = clamp(dot(light.direction, -direction) * light.cone_scale + light.cone_offset, 0.0, 1.0);
        irradiance *= cone * cone;
    }
    if (largest(irradiance) <= 0.0) return kNoLight;
    return LightSample(light.position - offsetOrigin(from, direction), 1.0, irradiance, light.pmf, true, true);
}

LightSample sampleLight(Surface from, SampleAddress address, uint dimension) {
    if (frame.light_count == 0u) return kNoLight;
    vec4 u = sample4(address, dimension + kDimensionLight);
    LightRecord light = lightAt(pickLight(u.xy));
    if (kLightTriangles && light.kind == kLightTriangle) return sampleTriangleLight(light, from, u.zw);
    if (kEnvironment && light.kind == kLightEnvironment) {
        EnvironmentSample e = sampleEnvironment(sampleBits4(address, dimension + kDimensionEnvironment));
        return LightSample(e.direction, uintBitsToFloat(0x7f800000u), environmentRadiance(e.direction), light.pmf * e.pdf, false, e.pdf > 0.0);
    }
    if (kPunctualLights) return samplePunctualLight(light, from);
    return kNoLight;
}

#endif
