#include "device_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "licht/core/error.h"
#include "licht/gpu/commands.h"
#include "licht/gpu/lanes.h"
#include "licht/shared/path.h"
#include "licht/spirv/check_ballots_comp.h"
#include "licht/spirv/check_device_comp.h"

namespace licht::gpu {
namespace {

std::vector<CheckQuestion> questions() {
    std::vector<CheckQuestion> all;
    for (uint thread = 0; thread < kCheckThreads; ++thread) all.push_back(checkQuestion(thread));
    return all;
}

/// Zeroed, mapped, and written by the device.
Buffer answerBuffer(Device& device, const char* name, std::size_t bytes, VkBufferUsageFlags usage = 0) {
    Buffer buffer(device, name, bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | usage, Memory::host_read);
    std::memset(buffer.mapped(), 0, bytes);
    return buffer;
}

template <typename Answer>
std::vector<Answer> answersIn(const Buffer& buffer, std::size_t count) {
    std::vector<Answer> answers(count);
    std::memcpy(answers.data(), buffer.mapped(), count * sizeof(Answer));
    return answers;
}

}  // namespace

DeviceAnswers askDevice(Device& device) {
    const std::vector<CheckQuestion> asked = questions();
    const std::size_t bytes = asked.size() * sizeof(CheckQuestion);
    const Buffer question_buffer(
        device, "check questions", bytes,
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT, Memory::host_write);
    std::memcpy(question_buffer.mapped(), asked.data(), bytes);
    const TexelView words(device, question_buffer, VK_FORMAT_R32G32B32A32_UINT);
    const TexelView floats(device, question_buffer, VK_FORMAT_R32G32B32A32_SFLOAT);
    const Buffer operations = answerBuffer(device, "check answers", kCheckThreads * sizeof(CheckAnswer));
    const Buffer groups =
        answerBuffer(device, "check groups", sizeof(uvec4), VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT);
    const Program check = Program::compute(device, "check device", check_device_comp, {});
    const Bindings bound(device, check,
                         std::array<BoundResource, 5>{{{"CheckQuestions", &question_buffer},
                                                       {"word_texels", &words},
                                                       {"float_texels", &floats},
                                                       {"CheckAnswers", &operations},
                                                       {"CheckGroups", &groups}}});
    Commands commands(device);
    commands.begin();
    commands.dispatch("check device", {check, bound}, {kCheckThreads});

    constexpr std::size_t kBallotAnswers = std::size_t{kCheckRounds} * kCheckThreads;
    Program ballot_check;
    Bindings ballots_bound;
    Buffer ballots = answerBuffer(device, "check ballots", kBallotAnswers * sizeof(BallotAnswer));
    Buffer counts =
        answerBuffer(device, "check counts", std::size_t{queueCountAt(kCheckRounds, 0)} * sizeof(uint));
    const bool offered = offersBallots(device);
    if (offered) {
        ballot_check = Program::compute(device, "check ballots", check_ballots_comp, {});
        ballots_bound =
            Bindings(device, ballot_check,
                     std::array<BoundResource, 2>{{{"QueueCounts", &counts}, {"BallotAnswers", &ballots}}});
        commands.dispatchIndirect("check ballots", {ballot_check, ballots_bound}, groups, 0);
    }
    commands.makeVisibleToHost(std::array{&operations, static_cast<const Buffer*>(&ballots)});
    commands.submit();
    commands.wait();
    return {answersIn<CheckAnswer>(operations, kCheckThreads),
            answersIn<BallotAnswer>(ballots, offered ? kBallotAnswers : 0)};
}

std::string_view checkDevice(Device& device) {
    const DeviceAnswers answers = askDevice(device);
    if (const std::string_view wrong = wrongOperation(answers.operations); !wrong.empty())
        throw DeviceError(
            fmt::format("'{}' ({}) computes wrong: {}", device.report().name, device.report().driver, wrong));
    return answers.ballots.empty() ? std::string_view{} : wrongBallotOperation(answers.ballots);
}

}  // namespace licht::gpu
