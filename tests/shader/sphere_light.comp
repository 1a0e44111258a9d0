#version 460
#extension GL_GOOGLE_include_directive : require
// Samples of the lights as seen from a place: what their rays meet, and what looking that up says.
#include "bound/light.glsl"

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

void onRay(vec3 origin, vec3 direction, float t_max, bool any_hit) {}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    Place place = places[i / per_place];
    g_address = SampleAddress(uvec2(i & 1023u, i >> 10u), 0u, 1u);
    Surface from;
    from.position = place.position;
    from.error_bound = place.error_bound;
    from.face_normal = place.normal;
    from.frame = frameFromNormal(place.normal);
    LightAsker asker = LightAsker(place.position, packOctahedral(place.normal), 0u, 0u);
    LightSample light = sampleLight(from, asker, g_address, 0u);
    RayQuery ray = RayQuery(offsetOrigin(from, light.direction), light.direction, light.t_max, light.valid, light.target, light.t_enough);
    bool arrives = light.valid && lightArrives(ray);
    if (!light.valid) ray = RayQuery(place.position, place.normal, uintBitsToFloat(0x7f800000u), true, kNoIndex, 0.0);
    Hit met = trace(ray.origin, ray.direction, ray.t_max, false);
    float looked_up = 0.0;
    if (met.instance != kNoIndex) looked_up = pdfOfSurface(surfaceAt(met, -normalize(ray.direction)), asker);
    answers[i] = Answer(light.direction, light.valid ? light.pdf : 0.0, looked_up, light.target, met.instance, arrives ? 1u : 0u);
}
