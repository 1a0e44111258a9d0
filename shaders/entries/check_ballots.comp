#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
// Asks a device what the wavefront depends on: ballots, and lists that subgroups append to. As there, lanes part before and come together again.
#include "path/append.glsl"
#include "shared/device_check.h"

layout(local_size_x = kCheckGroup) in;
layout(std430, binding = kFirstFreeBinding) writeonly buffer BallotAnswers { BallotAnswer ballot_answers[]; };

void main() {
    uint thread = gl_GlobalInvocationID.x;
    for (uint round = 0u; round < kCheckRounds; ++round) {
        BallotAnswer answer;
        bool wanted = checkWants(thread, round);
        answer.subgroup = gl_SubgroupID;
        answer.lane = gl_SubgroupInvocationID;
        answer.lanes = gl_SubgroupSize;
        answer.ballot = subgroupBallot(wanted);
        answer.bits = subgroupBallotBitCount(answer.ballot);
        answer.bits_below = subgroupBallotExclusiveBitCount(answer.ballot);
        answer.elected = subgroupElect() ? 1u : 0u;
        answer.first = subgroupBroadcastFirst(thread);
        uint place = appendTo(round, 0u, wanted);
        answer.place = wanted ? place : kNoIndex;
        uint left = checkWork(thread, round);
        answer.rounds = 0u;
        bool any_left = true;
        while (any_left) {
            if (left > 0u) --left;
            ++answer.rounds;
            any_left = subgroupBallotBitCount(subgroupBallot(left > 0u)) > 0u;
        }
        ballot_answers[kCheckThreads * round + thread] = answer;
    }
}
