// All tests on the device lean on what validation says of it, so here it must speak: of deliberate mistakes.
#include <gtest/gtest.h>

#include <algorithm>

#include "licht/gpu/commands.h"
#include "licht/spirv/validation_comp.h"
#include "support/gpu_test.h"

namespace licht::gpu {
namespace {

constexpr std::uint32_t kCount = 64;

Buffer numbers() {
    return Buffer(testDevice(), "numbers", kCount * sizeof(std::uint32_t),
                  VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, Memory::device);
}

/// What validation says to a pass that states no uses, so that no barriers come before or within.
template <typename Record>
std::vector<std::string> messagesOf(const Record& record) {
    Commands commands(testDevice());
    commands.begin();
    commands.pass("mistake", {}, record);
    commands.submit();
    commands.wait();
    return takeMessages();
}

void expectSaid(const std::vector<std::string>& messages, const std::string& part) {
    EXPECT_TRUE(std::any_of(messages.begin(), messages.end(),
                            [&](const std::string& text) { return text.find(part) != std::string::npos; }))
        << "'" << part << "' is in none of " << testing::PrintToString(messages);
}

TEST(Validation, saysWhatIsNotAllowed) {
    const Buffer buffer = numbers();
    expectSaid(messagesOf([&](VkCommandBuffer recording) {
                   vkCmdFillBuffer(recording, buffer.handle(), 2, VK_WHOLE_SIZE, 0);
               }),
               "VUID-vkCmdFillBuffer-dstOffset-00025");
}

TEST(Validation, saysThatTransfersRace) {
    const Buffer buffer = numbers();
    expectSaid(messagesOf([&](VkCommandBuffer recording) {
                   vkCmdFillBuffer(recording, buffer.handle(), 0, VK_WHOLE_SIZE, 0);
                   vkCmdFillBuffer(recording, buffer.handle(), 0, VK_WHOLE_SIZE, 1);
               }),
               "SYNC-HAZARD-WRITE-AFTER-WRITE");
}

TEST(Validation, saysThatShadersRace) {
    const Program program = Program::compute(testDevice(), "copy", validation_comp, {});
    const Buffer a = numbers();
    const Buffer b = numbers();
    const std::vector<BoundResource> forth = {{"from", &a}, {"to", &b}};
    const std::vector<BoundResource> back = {{"from", &b}, {"to", &a}};
    const Bindings there(testDevice(), program, forth);
    const Bindings home(testDevice(), program, back);
    const auto messages = messagesOf([&](VkCommandBuffer recording) {
        vkCmdBindPipeline(recording, VK_PIPELINE_BIND_POINT_COMPUTE, program.pipeline());
        for (const VkDescriptorSet set : {there.set(), home.set()}) {
            vkCmdBindDescriptorSets(recording, VK_PIPELINE_BIND_POINT_COMPUTE, program.layout(), 0, 1, &set,
                                    0, nullptr);
            vkCmdDispatch(recording, 1, 1, 1);
        }
    });
    expectSaid(messages, "SYNC-HAZARD-");
}

}  // namespace
}  // namespace licht::gpu
