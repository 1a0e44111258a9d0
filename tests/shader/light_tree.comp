#version 460
#extension GL_GOOGLE_include_directive : require
// Walks down a light tree: which light is picked with which probability, and what looking the same light up says.
#include "light/tree.glsl"
#include "pure/random.glsl"

layout(local_size_x = 64) in;
layout(push_constant) uniform Push { uint count; uint per_place; uint seed; };
struct Place {
    vec3 position;
    float alpha;
    vec3 normal;
    float specular;
    vec3 wo;
    float reserved;
};
struct Answer {
    uint light;
    float pmf;
    float looked_up;
    uint reserved;
};
layout(std430, binding = kFirstFreeBinding) readonly buffer Questions { Place places[]; };
layout(std430, binding = kFirstFreeBinding + 1u) writeonly buffer Answers { Answer answers[]; };
layout(std430, binding = kFirstFreeBinding + 2u) readonly buffer Trails { uint trails[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    Place place = places[i / per_place];
    vec4 u = random4(SampleAddress(uvec2(i & 1023u, i >> 10u), 0u, seed), 0u);
    ShadingPoint point = ShadingPoint(place.position, place.normal, place.wo, place.alpha, place.specular);
    TreePick pick = pickInTree(point, u.xy);
    bool picked = pick.light != kNoIndex;
    float looked_up = picked ? pmfInTree(point, trails[pick.light]) : 0.0;
    answers[i] = Answer(pick.light, picked ? pick.pmf : 0.0, looked_up, 0u);
}
