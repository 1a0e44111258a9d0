// What the choice among lights knows of the place that is to be lit.
#ifndef LICHT_LIGHT_SHADING_POINT_GLSL
#define LICHT_LIGHT_SHADING_POINT_GLSL

#include "pure/frame.glsl"

struct ShadingPoint {
    vec3 position;  // world
    vec3 normal;    // world, unit: of shading
    vec3 wo;        // world, unit, where it sends the light to
    float alpha;    // GGX width of its specular layer
    float specular; // F G / (4 cos_o) of the specular layer over the base's albedo; 0: Lambertian
};

// So that a path can carry it. Picking a light and looking its probability up both read it from here, or else they would not agree.
struct PackedShadingPoint {
    vec3 position;
    uint normal;
    uint wo;
    uint gloss;  // two halves: alpha; specular
};

const PackedShadingPoint kNoShadingPoint = PackedShadingPoint(vec3(0.0), 0u, 0u, 0u);

PackedShadingPoint packShadingPoint(ShadingPoint p) {
    return PackedShadingPoint(p.position, packOctahedral(p.normal), packOctahedral(p.wo), packHalf2x16(vec2(p.alpha, p.specular)));
}

ShadingPoint unpackShadingPoint(PackedShadingPoint p) {
    vec2 gloss = unpackHalf2x16(p.gloss);
    return ShadingPoint(p.position, unpackOctahedral(p.normal), unpackOctahedral(p.wo), gloss.x, gloss.y);
}

#endif
