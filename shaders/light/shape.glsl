// Triangles and rectangles that shine, sampled by solid angle or, where that is unsound, by area.
#ifndef LICHT_LIGHT_SHAPE_GLSL
#define LICHT_LIGHT_SHAPE_GLSL

#include "light/sample.glsl"
#include "pure/spherical.glsl"
#include "shared/light_views.h"

bool isRectangle(LightRecord r) { return kindOf(r) == kLightRectangle; }

// Where sampling by it is sound; 0 where the area is sampled instead. Sampling and looking up ask alike.
float sampledSolidAngle(LightRecord r, vec3 from) {
    ShapeLight light = unpackShape(r);
    vec3 corner = light.corner - from;
    float omega = isRectangle(r) ? solidAngleRectangle(corner, light.edge_u, light.edge_v)
                                 : solidAngleTriangle(corner, corner + light.edge_u, corner + light.edge_v);
    return omega > kSmallestSolidAngle && omega < kLargestSolidAngle ? omega : 0.0;
}

// Twice the area of a triangle, the area of a rectangle, along the normal.
vec3 areaVector(ShapeLight light) { return cross(light.edge_u, light.edge_v); }

// Density of the point at `d` from the vertex, by solid angle. d2: |d|^2.
float pdfOnShape(LightRecord r, float omega, vec3 d, float d2) {
    if (omega > 0.0) return 1.0 / omega;
    // Area to solid angle: r^2 / (A cos) = r^3 / |A . d|.
    float projected = abs(dot(areaVector(unpackShape(r)), d)) * (isRectangle(r) ? 1.0 : 0.5);
    return d2 * sqrt(d2) / projected;
}

// pmf: of the light's being picked. d: from the vertex to the point that was met.
float pdfOfShape(LightRecord r, float pmf, vec3 from, vec3 d) { return pmf * pdfOnShape(r, sampledSolidAngle(r, from), d, dot(d, d)); }

// Emitted at a point of its plane towards wo, seen from the front or the back.
vec3 radianceOfShape(LightRecord r, vec3 point, bool front, vec3 wo) {
    ShapeLight light = unpackShape(r);
    if (!front && (r.kind & kLightDoubleSided) == 0u) return vec3(0.0);
    if (!kUnevenEmission || (r.kind & kLightUneven) == 0u) return light.emission;
    vec3 n = areaVector(light);
    vec3 at = point - light.corner;
    float inverse = 1.0 / dot(n, n);
    vec2 b = clamp(vec2(dot(cross(at, light.edge_v), n), dot(cross(light.edge_u, at), n)) * inverse, 0.0, 1.0);
    return emissionAt(r.instance, r.primitive, vec3(1.0 - b.x - b.y, b), normalize(n), front, wo);
}

LightSample sampleShape(LightRecord r, float pmf, Vertex from, vec2 u) {
    ShapeLight light = unpackShape(r);
    vec3 corner = light.corner - from.position;
    vec3 area = areaVector(light);
    float omega = sampledSolidAngle(r, from.position);
    vec3 d;
    if (omega > 0.0) {
        if (isRectangle(r)) {
            d = sampleRectangleSolidAngle(corner, light.edge_u, light.edge_v, u);
        } else {
            vec3 w = sampleTriangleSolidAngle(corner, corner + light.edge_u, corner + light.edge_v, u);
            d = w * (dot(corner, area) / dot(w, area));
        }
    } else {
        vec2 b = isRectangle(r) ? u : sampleTriangle(u);
        d = corner + b.x * light.edge_u + b.y * light.edge_v;
    }
    float d2 = dot(d, d);
    vec3 radiance = radianceOfShape(r, from.position + d, dot(area, d) < 0.0, -normalize(d));
    float pdf = pmf * pdfOnShape(r, omega, d, d2);
    bool valid = d2 > 0.0 && largest(radiance) > 0.0 && pdf > 0.0 && !isinf(pdf);
    // The ray ends before the light's plane by as much as both may be off.
    vec3 normal = area * inversesqrt(dot(area, area));
    vec3 extent = abs(light.corner) + abs(light.edge_u) + abs(light.edge_v);
    float error_bound = kPositionUnits * (dot(abs(normal), extent) + largest(max(abs(light.edge_u), abs(light.edge_v))));
    vec3 target = offsetOrigin(from.position + d, normal, error_bound, -d);
    return lightSample(target - offsetOrigin(from, d), 1.0, radiance, pdf, false, valid);
}

#endif
