// The table of lights and the alias table over it, fetched.
#ifndef LICHT_LIGHT_TABLE_GLSL
#define LICHT_LIGHT_TABLE_GLSL

#include "bound/scene_data.glsl"
#include "shared/bindings.h"
#include "shared/light_views.h"

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

#endif
