#version 460
#extension GL_GOOGLE_include_directive : require
// Samples of the lights as seen from a place: what their rays meet, and what looking that up says.
#include "light/light.glsl"

layout(local_size_x = 64) in;
layout(push_constant) uniform Push { uint count; uint per_place; };
struct Place {
    vec3 position;
    float error_bound;
    vec3 normal;
    float reserved;
};
struct Answer {
    vec3 direction;
    float pdf;        // 0: no sample
    float looked_up;
    uint target;
    uint met;         // the instance that is nearest on the ray, or without a sample along the normal; kNoIndex: none
    uint arrives;
};
layout(std430, binding = kFirstFreeBinding) readonly buffer Questions { Place places[]; };
layout(std430, binding = kFirstFreeBinding + 1u) writeonly buffer Answers { Answer answers[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    Place place = places[i / per_place];
    SampleAddress address = SampleAddress(uvec2(i & 1023u, i >> 10u), 0u, 1u);
    Vertex from = Vertex(place.position, place.normal, place.error_bound);
    PackedShadingPoint at = packShadingPoint(ShadingPoint(place.position, place.normal, place.normal, 1.0, 0.0));
    LightSample light = sampleLight(from, at, address, 0u);
    vec3 origin = offsetOrigin(from, light.direction);
    ShadowRay shadow = kNoShadowRay;
    if (light.valid) {
        shadow = ShadowRay(sceneRay(shadowQuery(origin, light.direction, light.t_max, light.t_enough), address, 0u), light.target, vec3(0.0), true);
        trace(shadow.ray);
    }
    vec3 direction = light.valid ? light.direction : place.normal;
    SceneRay nearest = sceneRay(pathQuery(light.valid ? origin : place.position, direction), address, 0u);
    if (light.valid) nearest.query.t_max = light.t_max;
    trace(nearest);
    Hit met = nearest.hit;
    float looked_up = 0.0;
    if (met.instance != kNoIndex) looked_up = pdfOfSurface(surfaceAt(met, -normalize(direction)), at);
    answers[i] = Answer(light.direction, light.valid ? light.pdf : 0.0, looked_up, light.target, met.instance, light.valid && largest(arrivingShare(shadow)) > 0.0 ? 1u : 0u);
}
