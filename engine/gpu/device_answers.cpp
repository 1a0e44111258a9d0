// What a device that computes right answers to device_check.cpp.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <vector>

#include "device_check.h"

namespace licht::gpu {
namespace {

/// The nearest float, ties to even, of what a double holds exactly.
uint bitsOf(double exact) {
    return std::bit_cast<uint>(static_cast<float>(exact));
}

double valueOf(uint bits) {
    return static_cast<double>(std::bit_cast<float>(bits));
}

/// The triangle (0,0), (4,0), (0,4) with its edges, at the height 0, from below.
uint distanceFrom(uint thread) {
    const int x = static_cast<int>(thread % 16U) - 4;
    const int y = static_cast<int>(thread / 16U) - 2;
    return x >= 0 && y >= 0 && x + y <= 4 ? bitsOf(2.0 + thread) : 0U;
}

CheckAnswer rightAnswer(uint thread) {
    const CheckQuestion own = checkQuestion(thread);
    const CheckQuestion other = checkQuestion(checkPartner(thread));
    const double near_one = valueOf(own.near_one);
    const double factor = valueOf(own.factor);
    CheckAnswer answer{};
    answer.stored = other.near_one;
    answer.word_texel = other.factor;
    answer.float_texel = other.tiny;
    answer.sum = bitsOf(near_one + valueOf(own.tiny));
    answer.lost = bitsOf(valueOf(own.tiny) - (valueOf(answer.sum) - near_one));
    answer.product = bitsOf(factor * near_one);
    answer.product_less = bitsOf(valueOf(answer.product) - near_one);
    answer.finite = 7;
    answer.converted = static_cast<uint>(thread * factor) - (thread + 1) / 2;
    answer.halves = checkHalves(thread) + 0x04000400U;  // of the exponents
    answer.bits = static_cast<uint>(std::popcount(own.factor)) |
                  static_cast<uint>(std::bit_width(thread + 1) - 1) << 8U;
    answer.wrapped = own.factor * own.tiny + 1013904223U;
    const uint first = thread / kCheckGroup * kCheckGroup;
    answer.group_sum = kCheckGroup * first + kCheckGroup * (kCheckGroup - 1) / 2;
    answer.distance = distanceFrom(thread);
    return answer;
}

struct Operation {
    const char* name;
    uint CheckAnswer::*answer;
};
constexpr std::array kOperations = {
    Operation{"reading a storage buffer", &CheckAnswer::stored},
    Operation{"fetching a texel of words", &CheckAnswer::word_texel},
    Operation{"fetching a texel of floats", &CheckAnswer::float_texel},
    Operation{"rounding a sum", &CheckAnswer::sum},
    Operation{"rounding a product", &CheckAnswer::product},
    Operation{"a product and a sum that are rounded each", &CheckAnswer::product_less},
    Operation{"what rounding takes from a sum", &CheckAnswer::lost},
    Operation{"comparing with infinity", &CheckAnswer::finite},
    Operation{"converting between words and floats", &CheckAnswer::converted},
    Operation{"half floats", &CheckAnswer::halves},
    Operation{"counting bits", &CheckAnswer::bits},
    Operation{"multiplying words", &CheckAnswer::wrapped},
    Operation{"atomics in shared memory", &CheckAnswer::group_sum},
    Operation{"the distance of a triangle along a ray", &CheckAnswer::distance},
};

/// Whether places are those of a list, each given once.
bool areAList(std::vector<uint> places) {
    std::sort(places.begin(), places.end());
    for (uint i = 0; i < places.size(); ++i)
        if (places[i] != i) return false;
    return true;
}

using Mask = std::array<uint, 4>;

/// The lanes of one subgroup in one round.
struct Subgroup {
    std::map<uint, uint> threads;  ///< by lane
    Mask ballot{};
    uint rounds = 1;
};

bool bitOf(const Mask& mask, uint lane) {
    return (mask[lane / 32] >> (lane % 32) & 1U) != 0;
}

uint bitsBelow(const Mask& mask, uint lane) {
    uint count = 0;
    for (uint below = 0; below < lane; ++below) count += bitOf(mask, below) ? 1U : 0U;
    return count;
}

/// What the subgroup of this thread must have found; none where its lanes are not numbered as they should.
std::map<std::pair<uint, uint>, Subgroup> subgroupsOf(std::span<const BallotAnswer> answers, uint round) {
    std::map<std::pair<uint, uint>, Subgroup> subgroups;
    for (uint thread = 0; thread < kCheckThreads; ++thread) {
        const BallotAnswer& answer = answers[thread];
        if (answer.lane >= std::min(answer.lanes, 128U) || answer.lanes != answers[0].lanes) return {};
        Subgroup& subgroup = subgroups[{thread / kCheckGroup, answer.subgroup}];
        if (!subgroup.threads.insert({answer.lane, thread}).second) return {};
        if (checkWants(thread, round)) subgroup.ballot[answer.lane / 32] |= 1U << (answer.lane % 32);
        subgroup.rounds = std::max(subgroup.rounds, checkWork(thread, round));
    }
    return subgroups;
}

std::string_view wrongInSubgroup(const BallotAnswer& answer, const Subgroup& subgroup) {
    const auto [first_lane, first_thread] = *subgroup.threads.begin();
    const Mask answered{answer.ballot.x, answer.ballot.y, answer.ballot.z, answer.ballot.w};
    if (answered != subgroup.ballot) return "subgroupBallot";
    if (answer.bits != bitsBelow(subgroup.ballot, 128)) return "subgroupBallotBitCount";
    if (answer.bits_below != bitsBelow(subgroup.ballot, answer.lane))
        return "subgroupBallotExclusiveBitCount";
    if (answer.elected != (answer.lane == first_lane ? 1U : 0U)) return "subgroupElect";
    if (answer.first != first_thread) return "subgroupBroadcastFirst";
    if (answer.rounds != subgroup.rounds) return "a loop that a subgroup leaves together";
    return {};
}

}  // namespace

CheckQuestion checkQuestion(uint thread) {
    const auto t = static_cast<double>(thread);
    return {bitsOf(1.0 + std::ldexp(t, -23)), bitsOf(1.0 + std::ldexp(2.0 * t + 1.0, -12)),
            bitsOf(std::ldexp(t + 1.0, -25)), bitsOf(std::ldexp(1.0, static_cast<int>(thread) - 64))};
}

std::string_view wrongOperation(std::span<const CheckAnswer> answers) {
    std::vector<CheckAnswer> right;
    for (uint thread = 0; thread < kCheckThreads; ++thread) right.push_back(rightAnswer(thread));
    for (const Operation& operation : kOperations)
        for (uint thread = 0; thread < kCheckThreads; ++thread)
            if (answers[thread].*operation.answer != right[thread].*operation.answer) return operation.name;
    std::vector<uint> places;
    for (const CheckAnswer& answer : answers) places.push_back(answer.place);
    return areAList(places) ? std::string_view{} : "atomics in a storage buffer";
}

std::string_view wrongBallotOperation(std::span<const BallotAnswer> answers) {
    if (answers.front().lanes == 0) return "an indirect dispatch";
    for (uint round = 0; round < kCheckRounds; ++round) {
        const std::span<const BallotAnswer> of_round =
            answers.subspan(std::size_t{kCheckThreads} * round, kCheckThreads);
        const auto subgroups = subgroupsOf(of_round, round);
        if (subgroups.empty()) return "the numbers of subgroups and lanes";
        std::vector<uint> places;
        for (uint thread = 0; thread < kCheckThreads; ++thread) {
            const BallotAnswer& answer = of_round[thread];
            const std::string_view wrong =
                wrongInSubgroup(answer, subgroups.at({thread / kCheckGroup, answer.subgroup}));
            if (!wrong.empty()) return wrong;
            if (checkWants(thread, round)) places.push_back(answer.place);
        }
        if (!areAList(places)) return "appending to a list by subgroups";
    }
    return {};
}

}  // namespace licht::gpu
