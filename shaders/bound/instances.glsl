// Where meshes that are stored once and placed often stand. Compiled out where the scene has none.
#ifndef LICHT_BOUND_INSTANCES_GLSL
#define LICHT_BOUND_INSTANCES_GLSL
#include "bound/instance_effect.glsl"
#include "shared/bindings.h"
#include "shared/constants.h"
#include "shared/geometry.h"

// Instances below this number are baked: their vertices are in world space.
layout(constant_id = kConstantBakedInstances) const uint kBakedInstances = 0xffffffffu;

layout(std430, binding = kBindingInstanceTransforms) readonly buffer InstanceTransforms { InstanceTransformRecord instance_transforms[]; };

// world = (dot(x, object), dot(y, object), dot(z, object)) + pivot.
struct Placement {
    vec3 x;
    vec3 y;
    vec3 z;
    vec3 pivot;
    float condition;  // 0: baked, nothing is rounded
    bool mirrored;
};

const Placement kBaked = Placement(vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0), vec3(0.0), 0.0, false);

Placement placementOf(uint instance) {
    if (!kInstances || instance < kBakedInstances) return kBaked;
    InstanceTransformRecord t = instance_transforms[instance - kBakedInstances];
    return Placement(t.world_x, t.world_y, t.world_z, vec3(t.pivot_x, t.pivot_y, t.pivot_z), t.condition, t.mirrored != 0u);
}

// Tells the instances of a mesh apart where numbers are drawn for their triangles; 0 for what is baked.
uint placementKey(uint instance) { return instance < kBakedInstances ? 0u : (instance + 1u) * 0x85ebca6bu; }

vec3 worldVector(Placement p, vec3 v) { return kInstances ? vec3(dot(p.x, v), dot(p.y, v), dot(p.z, v)) : v; }

vec3 worldPoint(Placement p, vec3 v) { return kInstances ? worldVector(p, v) + p.pivot : v; }

vec3 unitOrZero(vec3 v) {
    float length2 = dot(v, v);
    return length2 > 0.0 ? v * inversesqrt(length2) : vec3(0.0);
}

// Cofactors are the inverse transpose without its division.
vec3 worldNormal(Placement p, vec3 n) {
    if (!kInstances) return n;
    vec3 turned = vec3(dot(cross(p.y, p.z), n), dot(cross(p.z, p.x), n), dot(cross(p.x, p.y), n));
    return unitOrZero(p.mirrored ? -turned : turned);
}

vec4 worldTangent(Placement p, vec4 t) {
    return kInstances ? vec4(unitOrZero(worldVector(p, t.xyz)), p.mirrored ? -t.w : t.w) : t;
}

#endif
