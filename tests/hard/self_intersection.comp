#version 460
#extension GL_GOOGLE_include_directive : require
// Rays that leave a hit the way paths do. One thread per ray.
#include "ray/visibility.glsl"

layout(local_size_x = 64) in;
layout(push_constant) uniform Push { uint ray_count; } push;

struct Question {
    vec3 direction;   // unit, away from the surface
    uint triangle;    // of the scene's list
    float b1;         // where on it
    float b2;
    uint instance;
    uint primitive;
};
struct Answer {
    uint own_plane;   // 1: the ray meets its own triangle, asked alone
    uint instance;    // what it hits in the scene
    uint primitive;
    float error_bound;
};
layout(std430, binding = kFirstFreeBinding) readonly buffer QuestionBlock { Question questions[]; };
layout(std430, binding = kFirstFreeBinding + 1u) writeonly buffer AnswerBlock { Answer answers[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.ray_count) return;
    Question q = questions[i];
    Hit hit = Hit(q.instance, q.primitive, q.b1, q.b2);
    Surface s = surfaceAt(hit, q.direction);
    vec3 origin = offsetOrigin(vertexOn(s), q.direction);

    uvec3 v = triangleVertices(hit.instance, hit.primitive);
    vec3 p0 = vertexAt(v.x).position, p1 = vertexAt(v.y).position, p2 = vertexAt(v.z).position;
    RaySetup ray;
    TriangleHit alone;
    bool met = setUpRay(origin, q.direction, min(min(p0, p1), p2), max(max(p0, p1), p2), ray) && testTriangle(ray, p0, p1, p2, alone);
    SceneRay next = sceneRay(pathQuery(origin, q.direction), SampleAddress(uvec2(i, 0u), 0u, 0u), 0u);
    trace(next);
    answers[i] = Answer(met && alone.t >= 0.0 ? 1u : 0u, next.hit.instance, next.hit.primitive, s.error_bound);
}
