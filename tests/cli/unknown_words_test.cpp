#include "samples/licht/unknown_words.h"

#include <gtest/gtest.h>

#include <vector>

namespace licht {
namespace {

TEST(EditDistance, CountsInsertionsRemovalsChangesAndSwaps) {
    EXPECT_EQ(editDistance("", ""), 0U);
    EXPECT_EQ(editDistance("spp", "spp"), 0U);
    EXPECT_EQ(editDistance("", "spp"), 3U);
    EXPECT_EQ(editDistance("sppp", "spp"), 1U);
    EXPECT_EQ(editDistance("sp", "spp"), 1U);
    EXPECT_EQ(editDistance("spq", "spp"), 1U);
    EXPECT_EQ(editDistance("psp", "spp"), 1U);
    EXPECT_EQ(editDistance("siez", "size"), 1U);
    EXPECT_EQ(editDistance("ca", "abc"), 3U) << "no letter is touched twice";
    EXPECT_EQ(editDistance("kitten", "sitting"), 3U);
}

TEST(NearestOption, IsNearOrNone) {
    const std::vector<std::string> options{"--spp", "--size", "--time", "--environment",
                                           "--environment-strength"};
    EXPECT_EQ(nearestOption("--sppp", options), "--spp");
    EXPECT_EQ(nearestOption("--siez", options), "--size");
    EXPECT_EQ(nearestOption("--env", options), "--environment") << "one begins so";
    EXPECT_EQ(nearestOption("--enviroment-strenght", options), "--environment-strength");
    EXPECT_EQ(nearestOption("--frobnicate", options), "");
    EXPECT_EQ(nearestOption("-x", options), "");
}

TEST(DescribeUnknown, NamesOptionsFirstAndOthersOnlyWithoutThem) {
    const std::vector<std::string> options{"--spp"};
    EXPECT_EQ(describeUnknown(std::vector<std::string>{"--sp=3", "4", "-q"}, options),
              "unknown: --sp (did you mean --spp?), -q");
    EXPECT_EQ(describeUnknown(std::vector<std::string>{"a", "b"}, options), "unexpected: 'a', 'b'");
}

}  // namespace
}  // namespace licht
