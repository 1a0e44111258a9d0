#version 460
#extension GL_GOOGLE_include_directive : require
// Traces each pixel's primary ray again through what the rasteriser saw, and says how far the two are apart.
#include "camera/gbuffer.glsl"
#include "ray/visibility.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Push { SamplePush push; };

struct Outcome {
    uint kind;      // 0 nothing seen, 1 the same primitive, 2 another, 3 the ray met nothing
    float edge;     // pixels from what was seen to the nearest edge of its triangle or of the one that was met
    float ulps;     // of the largest coordinate: distance of the two positions, the same primitive alone
    float cosine;   // of the ray to the primitive's normal
};
layout(std430, binding = kFirstFreeBinding) writeonly buffer OutcomeBlock { Outcome outcomes[]; };

vec2 pixelOf(uint vertex, Placement at) { return pixelFromWorld(frame.view, worldPoint(at, vertexAt(vertex).position)); }

float toSegment(vec2 p, vec2 a, vec2 b) {
    vec2 ab = b - a;
    float along = clamp(dot(p - a, ab) / max(dot(ab, ab), 1e-30), 0.0, 1.0);
    return distance(p, a + along * ab);
}

// Edges that reach behind the camera count as far away.
float toEdges(vec2 p, Hit hit) {
    uvec3 v = triangleVertices(hit.instance, hit.primitive);
    Placement at = placementOf(hit.instance);
    vec2 a = pixelOf(v.x, at), b = pixelOf(v.y, at), c = pixelOf(v.z, at);
    return min(min(toSegment(p, a, b), toSegment(p, b, c)), toSegment(p, c, a));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = imageSize(gbuffer);
    if (any(greaterThanEqual(pixel, size))) return;
    uint index = uint(pixel.y * size.x + pixel.x);
    Hit seen = gbufferHit(pixel);
    outcomes[index] = Outcome(0u, 0.0, 0.0, 0.0);
    if (seen.instance == kNoIndex) return;
    vec3 target = hitPosition(seen);
    vec3 away = -directionToCamera(frame.view, target);
    // Nothing before the near plane is drawn.
    SceneRay ray = sceneRay(pathQuery(frame.view.eye + away * frame.view.z_near, away), SampleAddress(uvec2(pixel), push.sample_index, frame.seed), 0u);
    trace(ray);
    Hit traced = ray.hit;
    vec2 p = pixelFromWorld(frame.view, target);
    if (traced.instance == kNoIndex) {
        outcomes[index] = Outcome(3u, toEdges(p, seen), 0.0, 0.0);
    } else if (traced.instance == seen.instance && traced.primitive == seen.primitive) {
        vec3 normal = surfaceAt(seen, -away).face_normal;
        vec3 apart = abs(hitPosition(traced) - target);
        vec3 largest3 = max(abs(target), abs(target - frame.view.eye));
        float unit = max(max(largest3.x, largest3.y), largest3.z) * 1.1920929e-7;
        outcomes[index] = Outcome(1u, 0.0, max(max(apart.x, apart.y), apart.z) / unit, abs(dot(away, normal)));
    } else {
        outcomes[index] = Outcome(2u, min(toEdges(p, seen), toEdges(p, traced)), 0.0, 0.0);
    }
}
