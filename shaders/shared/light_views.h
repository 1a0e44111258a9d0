// What a LightRecord says of each kind of light: its packing and unpacking, for host and device alike. These structs stand in no buffer.
#ifndef LICHT_SHARED_LIGHT_VIEWS_H
#define LICHT_SHARED_LIGHT_VIEWS_H
#include "light.h"

LICHT_SHARED_BEGIN

LICHT_FUNCTION uint kindOf(LightRecord r) {
    return r.kind & kLightKindMask;
}

// A triangle or a rectangle: a corner and the edges from there to its neighbours, which turn counter-clockwise seen from the front.
struct ShapeLight {
    vec3 corner;  // world
    vec3 edge_u;
    vec3 edge_v;
    vec3 emission;  // cd/m^2, before a texture
};

LICHT_FUNCTION LightRecord packShape(LightRecord r, ShapeLight light) {
    r.a = light.corner;
    r.b = light.edge_u;
    r.c = light.edge_v;
    r.d = light.emission;
    return r;
}

LICHT_FUNCTION ShapeLight unpackShape(LightRecord r) {
    ShapeLight light;
    light.corner = r.a;
    light.edge_u = r.b;
    light.edge_v = r.c;
    light.emission = r.d;
    return light;
}

// A round mesh, by the sphere around it.
struct SphereLight {
    vec3 centre;  // world
    float radius;
    vec3 emission;  // cd/m^2
};

LICHT_FUNCTION LightRecord packSphere(LightRecord r, SphereLight light) {
    r.a = light.centre;
    r.u = light.radius;
    r.d = light.emission;
    return r;
}

LICHT_FUNCTION SphereLight unpackSphere(LightRecord r) {
    SphereLight light;
    light.centre = r.a;
    light.radius = r.u;
    light.emission = r.d;
    return light;
}

// A directional light, a sun where it fills an angle.
struct SunLight {
    vec3 direction;    // the way the light travels, world, unit
    vec3 illuminance;  // lux on a surface that faces it
    float sine2;       // of half the angle that it fills, squared; 0: none
};

LICHT_FUNCTION LightRecord packSun(LightRecord r, SunLight light) {
    r.b = light.direction;
    r.c = light.illuminance;
    r.v = light.sine2;
    return r;
}

LICHT_FUNCTION SunLight unpackSun(LightRecord r) {
    SunLight light;
    light.direction = r.b;
    light.illuminance = r.c;
    light.sine2 = r.v;
    return light;
}

// A point, or a spot, whose light falls off by clamp(offset - scale * (1 - cos), 0, 1)^2 with the angle to its axis. 1 - cos, because the cosines of narrow
// cones are all next to one.
struct SpotLight {
    vec3 position;   // world
    float range;     // metres; 0: unlimited
    vec3 intensity;  // cd
    vec3 axis;       // the way the light travels, world, unit; of a spot alone, as all below
    float scale;
    float offset;
};

LICHT_FUNCTION LightRecord packSpot(LightRecord r, SpotLight light) {
    r.a = light.position;
    r.u = light.range;
    r.c = light.intensity;
    r.b = light.axis;
    r.v = light.scale;
    r.w = light.offset;
    return r;
}

LICHT_FUNCTION SpotLight unpackSpot(LightRecord r) {
    SpotLight light;
    light.position = r.a;
    light.range = r.u;
    light.intensity = r.c;
    light.axis = r.b;
    light.scale = r.v;
    light.offset = r.w;
    return light;
}

LICHT_SHARED_END
#endif
