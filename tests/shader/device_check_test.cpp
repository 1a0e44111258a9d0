// A device is asked before it draws, and each operation that it may get wrong is named.
#include "licht/gpu/device_check.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "licht/gpu/driver_faults.h"
#include "licht/gpu/lanes.h"
#include "support/gpu_test.h"

namespace licht::gpu {
namespace {

/// Of the test's device: what it answers is right, so what the tests below change is all that is wrong.
const DeviceAnswers& answers() {
    static const DeviceAnswers asked = askDevice(testDevice());
    return asked;
}

TEST(DeviceCheck, TheTestsDeviceComputesRight) {
    EXPECT_EQ(wrongOperation(answers().operations), "");
    EXPECT_EQ(answers().ballots.empty(), !offersBallots(testDevice()));
    if (!answers().ballots.empty()) {
        EXPECT_EQ(wrongBallotOperation(answers().ballots), "");
    }
    EXPECT_EQ(testDevice().ballotTrouble(), "");
    EXPECT_EQ(hasBallots(testDevice()), offersBallots(testDevice()));
}

/// What is said where one thread's answer, or all, are changed.
template <typename Answer>
void expectNamed(const std::vector<Answer>& right, std::string_view (*wrongOf)(std::span<const Answer>),
                 const std::function<void(Answer&)>& change, const std::string& name) {
    for (const std::size_t thread : {std::size_t{0}, std::size_t{77}, right.size() - 1}) {
        std::vector<Answer> changed = right;
        change(changed[thread]);
        EXPECT_EQ(wrongOf(changed), name) << "of thread " << thread;
    }
    std::vector<Answer> changed = right;
    for (Answer& answer : changed) change(answer);
    EXPECT_EQ(wrongOf(changed), name) << "of all threads";
}

TEST(DeviceCheck, NamesTheOperationThatIsWrong) {
    const std::vector<std::pair<uint CheckAnswer::*, std::string>> named{
        {&CheckAnswer::stored, "reading a storage buffer"},
        {&CheckAnswer::word_texel, "fetching a texel of words"},
        {&CheckAnswer::float_texel, "fetching a texel of floats"},
        {&CheckAnswer::sum, "rounding a sum"},
        {&CheckAnswer::product, "rounding a product"},
        {&CheckAnswer::product_less, "a product and a sum that are rounded each"},
        {&CheckAnswer::lost, "what rounding takes from a sum"},
        {&CheckAnswer::finite, "comparing with infinity"},
        {&CheckAnswer::converted, "converting between words and floats"},
        {&CheckAnswer::halves, "half floats"},
        {&CheckAnswer::bits, "counting bits"},
        {&CheckAnswer::wrapped, "multiplying words"},
        {&CheckAnswer::group_sum, "atomics in shared memory"},
        {&CheckAnswer::distance, "the distance of a triangle along a ray"},
        {&CheckAnswer::place, "atomics in a storage buffer"}};
    EXPECT_EQ(named.size() * sizeof(uint), sizeof(CheckAnswer)) << "one for every answer";
    for (const auto& [member, name] : named)
        expectNamed<CheckAnswer>(
            answers().operations, wrongOperation,
            [member = member](CheckAnswer& answer) { answer.*member ^= 0x100U; }, name);
    EXPECT_NE(wrongOperation(std::vector<CheckAnswer>(kCheckThreads)), "") << "no answer at all";
}

TEST(DeviceCheck, NamesTheBallotOperationThatIsWrong) {
    if (answers().ballots.empty()) return;
    using Change = std::function<void(BallotAnswer&)>;
    const std::vector<std::pair<Change, std::string>> named{
        {[](BallotAnswer& answer) { answer.ballot.x ^= 1U; }, "subgroupBallot"},
        {[](BallotAnswer& answer) { answer.ballot.w ^= 1U; }, "subgroupBallot"},
        {[](BallotAnswer& answer) { ++answer.bits; }, "subgroupBallotBitCount"},
        {[](BallotAnswer& answer) { ++answer.bits_below; }, "subgroupBallotExclusiveBitCount"},
        {[](BallotAnswer& answer) { answer.elected ^= 1U; }, "subgroupElect"},
        {[](BallotAnswer& answer) { answer.first += 200; }, "subgroupBroadcastFirst"},
        {[](BallotAnswer& answer) { ++answer.rounds; }, "a loop that a subgroup leaves together"},
        {[](BallotAnswer& answer) { answer.lane += answer.lanes; }, "the numbers of subgroups and lanes"}};
    for (const auto& [change, name] : named)
        expectNamed<BallotAnswer>(answers().ballots, wrongBallotOperation, change, name);

    std::vector<BallotAnswer> changed = answers().ballots;
    for (std::size_t i = kCheckThreads; i < changed.size(); ++i)
        changed[i].place = changed[i].place == kNoIndex ? kNoIndex : changed[i].place / 2;
    EXPECT_EQ(wrongBallotOperation(changed), "appending to a list by subgroups") << "places given twice";
    EXPECT_EQ(wrongBallotOperation(std::vector<BallotAnswer>(answers().ballots.size())),
              "an indirect dispatch")
        << "no answer at all";
}

TEST(DriverFaults, RefuseWhatWouldCrashBeforeItCouldAnswer) {
    const DriverFacts wide{VK_DRIVER_ID_MESA_LLVMPIPE, "Mesa 25.0.7-2+deb13u1 (LLVM 19.1.7)", 16};
    ASSERT_EQ(knownFaults(wide).size(), 1U);
    EXPECT_NE(knownFaults(wide)[0].find("16 lanes"), std::string::npos) << knownFaults(wide)[0];
    DriverFacts usual = wide;
    usual.lanes = 8;
    EXPECT_TRUE(knownFaults(usual).empty());
    DriverFacts old = wide;
    old.info = "Mesa 22.3.6 (LLVM 15.0.6)";
    EXPECT_TRUE(knownFaults(old).empty()) << "is right with 16 lanes";
    DriverFacts other = wide;
    other.id = VK_DRIVER_ID_MESA_RADV;
    EXPECT_TRUE(knownFaults(other).empty());
    other.id = VK_DRIVER_ID_GOOGLE_SWIFTSHADER;
    ASSERT_EQ(knownFaults(other).size(), 1U);
    EXPECT_NE(knownFaults(other)[0].find("SwiftShader"), std::string::npos) << knownFaults(other)[0];
    EXPECT_TRUE(knownFaults(driverFacts(testDevice().physicalDevice())).empty());
}

}  // namespace
}  // namespace licht::gpu
