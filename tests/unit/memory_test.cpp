#include "licht/core/memory.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "licht/core/error.h"

namespace licht {
namespace {

std::string refusal(double bytes) {
    try {
        requireMemory(bytes, "they take");
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

/// The limit of the process, put back at the end.
class Memory : public testing::Test {
protected:
    void TearDown() override { limitMemory(before_); }

private:
    std::uint64_t before_ = memoryLimit();
};

TEST_F(Memory, OfAProcessGrowsWithWhatItTouches) {
    const std::uint64_t before = memoryInUse();
    ASSERT_GT(before, 0U);
    constexpr std::size_t kBytes = std::size_t{64} << 20U;
    const std::vector<char> touched(kBytes, 1);
    EXPECT_GE(memoryInUse(), before + kBytes / 2) << touched.size();
}

TEST_F(Memory, IsLimitedByTheMachineWhereNothingElseIsSaid) {
    EXPECT_GT(memoryLimit(), memoryInUse());
    EXPECT_EQ(refusal(1.0), "");
    // More than any machine has, and more than 64 bits count.
    EXPECT_NE(refusal(1e18), "");
    EXPECT_NE(refusal(1e30), "");
}

TEST_F(Memory, BeyondTheLimitIsRefusedWithAllNumbers) {
    limitMemory(memoryInUse() + (std::uint64_t{3} << 30U));
    EXPECT_EQ(refusal(2.0 * 0x1p30), "");
    const std::string text = refusal(5.5 * 0x1p30);
    EXPECT_EQ(text.rfind("they take about 5.5 GiB of memory beside ", 0), 0U) << text;
    EXPECT_NE(text.find("the limit is 3.0 GiB (--memory-limit)"), std::string::npos) << text;
}

TEST_F(Memory, IsToldInPowersOf1024) {
    EXPECT_EQ(bytesInWords(0.0), "0 bytes");
    EXPECT_EQ(bytesInWords(1023.0), "1023 bytes");
    EXPECT_EQ(bytesInWords(1536.0), "1.5 KiB");
    EXPECT_EQ(bytesInWords(48.0 * 0x1p20), "48 MiB");
    EXPECT_EQ(bytesInWords(2.5 * 0x1p40), "2.5 TiB");
}

}  // namespace
}  // namespace licht
