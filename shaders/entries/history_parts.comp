#version 460
#extension GL_GOOGLE_include_directive : require
// While the view moves a pixel has few samples, so that edges would crawl. Where pixels side by side show different surfaces, rays through a pixel ask which
// part of it shows which, and from which pixel's light each part is to be drawn: visibility is cheap, light is not (Burns, Hunt 2013, The Visibility Buffer:
// shading apart from visibility).
#include "history/edges.glsl"
#include "ray/visibility.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Push { ReprojectPush push; };
layout(r32f, binding = kBindingEdgeParts) uniform image2D edge_parts;

// A square turned by 26.6 degrees: each part has a row and a column of its own.
const vec2 kPlaces[kEdgeParts] = vec2[](vec2(0.375, 0.125), vec2(0.875, 0.375), vec2(0.125, 0.625), vec2(0.625, 0.875));

vec3 faceNormalOf(Hit hit) {
    uvec3 v = triangleVertices(hit.instance, hit.primitive);
    return faceOf(placementOf(hit.instance), vertexAt(v.x).position, vertexAt(v.y).position, vertexAt(v.z).position).normal;
}

// Of the pixels around, the one whose sample lies nearest to that place in the pixel among those of the surface that is there; by its number, row by row.
int sourceOf(ivec2 pixel, vec2 place, vec2 jitter, uint part) {
    CameraRay camera = cameraRay(frame.view, vec2(pixel) + place);
    float cos_axis = -dot(frame.view.back, camera.direction);
    RayQuery query = pathQuery(camera.origin, camera.direction);
    query.t_min = frame.view.orthographic != 0u ? 0.0 : frame.view.z_near / cos_axis;
    query.t_max = min(query.t_max, frame.view.z_limit / cos_axis);
    SceneRay ray = sceneRay(query, SampleAddress(uvec2(pixel), kEdgeParts * push.sample_index + part, frame.seed), 0u);
    trace(ray);
    vec3 position = vec3(0.0), normal = vec3(0.0);
    if (ray.hit.instance != kNoIndex) {
        position = hitPosition(ray.hit);
        normal = faceNormalOf(ray.hit);
    }
    int source = kEdgeSelf;
    float nearest = infinity();
    for (int i = 0; i < 9; ++i) {
        ivec2 offset = ivec2(i % 3, i / 3) - 1;
        vec2 way = vec2(offset) + jitter - place;
        if (!isInside(pixel + offset) || dot(way, way) >= nearest || !isOf(pixel + offset, ray.hit.instance, position, normal)) continue;
        nearest = dot(way, way);
        source = i;
    }
    return source;
}

// The parts of a pixel are side by side, so that few lanes idle where edges are thin.
void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.x / kEdgeParts, gl_GlobalInvocationID.y);
    uint part = gl_GlobalInvocationID.x % kEdgeParts;
    if (!isInside(pixel)) return;
    ivec2 size = imageSize(edge_parts);
    if (imageLoad(edge_parts, tilePlace(size, frame.view.size, kEdgeMark, uvec2(pixel))).x == 0.0) return;
    int source = sourceOf(pixel, kPlaces[part], cameraJitter(push.sample_index, frame.seed), part);
    imageStore(edge_parts, tilePlace(size, frame.view.size, part, uvec2(pixel)), vec4(float(source)));
}
