#version 460
#extension GL_GOOGLE_include_directive : require
// Asks a device what every program depends on: fetches, sums that are rounded as IEEE 754 says, atomics, and whether rays meet a triangle.
#include "pure/finite.glsl"
#include "pure/intersect.glsl"
#include "shared/bindings.h"
#include "shared/device_check.h"

layout(local_size_x = kCheckGroup) in;
layout(std430, binding = kFirstFreeBinding) readonly buffer CheckQuestions { CheckQuestion questions[]; };
layout(binding = kFirstFreeBinding + 1u) uniform usamplerBuffer word_texels;   // the same
layout(binding = kFirstFreeBinding + 2u) uniform samplerBuffer float_texels;  // the same
layout(std430, binding = kFirstFreeBinding + 3u) writeonly buffer CheckAnswers { CheckAnswer answers[]; };
// VkDispatchIndirectCommand of the second program, and the length of a list that all threads append to.
layout(std430, binding = kFirstFreeBinding + 4u) buffer CheckGroups { uvec4 groups; };

shared uint s_sum;

// Of a triangle in the plane z = 0 along a ray that meets that plane at a corner of a grid: whole numbers, so every edge function is exact.
uint distanceBits(uint thread) {
    vec3 origin = vec3(float(thread % 16u) - 4.0, float(thread / 16u) - 2.0, -2.0 - float(thread));
    RaySetup ray;
    TriangleHit hit;
    bool sound = setUpRay(origin, vec3(0.0, 0.0, 1.0), vec3(0.0), vec3(4.0), ray);
    bool met = sound && testTriangle(ray, vec3(0.0), vec3(4.0, 0.0, 0.0), vec3(0.0, 4.0, 0.0), hit);
    return met ? floatBitsToUint(hit.t * ray.direction_scale) : 0u;
}

void main() {
    uint thread = gl_GlobalInvocationID.x;
    if (gl_LocalInvocationIndex == 0u) s_sum = 0u;
    barrier();
    atomicAdd(s_sum, thread);
    barrier();

    CheckAnswer answer;
    CheckQuestion own = questions[thread];
    float near_one = uintBitsToFloat(own.near_one), factor = uintBitsToFloat(own.factor), tiny = uintBitsToFloat(own.tiny);
    int partner = int(checkPartner(thread));
    answer.stored = questions[partner].near_one;
    answer.word_texel = texelFetch(word_texels, partner).y;
    answer.float_texel = floatBitsToUint(texelFetch(float_texels, partner).z);
    precise float sum = near_one + tiny;
    precise float lost = tiny - (sum - near_one);
    precise float product = factor * near_one;
    precise float product_less = factor * near_one - near_one;
    answer.sum = floatBitsToUint(sum);
    answer.lost = floatBitsToUint(lost);
    answer.product = floatBitsToUint(product);
    answer.product_less = floatBitsToUint(product_less);
    float beyond = uintBitsToFloat(own.beyond);
    answer.finite = (beyond < infinity() ? 1u : 0u) | (-infinity() < beyond ? 2u : 0u) | (allFinite(vec3(beyond)) ? 4u : 0u) |
                    (allFinite(vec3(uintBitsToFloat(own.beyond | 0x7f800000u))) ? 8u : 0u);
    answer.converted = uint(float(thread) * factor) + uint(int(floor(-0.5 * float(thread))));
    answer.halves = packHalf2x16(2.0 * unpackHalf2x16(checkHalves(thread)));
    answer.bits = uint(bitCount(own.factor)) | (uint(findMSB(thread + 1u)) << 8u);
    answer.wrapped = own.factor * own.tiny + 1013904223u;
    answer.group_sum = s_sum;
    answer.place = atomicAdd(groups.w, 1u);
    answer.distance = distanceBits(thread);
    answers[thread] = answer;
    if (thread == 0u) groups.xyz = uvec3(kCheckGroups, 1u, 1u);
}
