// What of a text reaches a terminal.
#include "licht/core/one_line.h"

#include <gtest/gtest.h>

namespace licht {
namespace {

TEST(OneLine, KeepsWhatOnlyShows) {
    EXPECT_EQ(oneLine("Gr\xc3\xbc\xc3\x9f\xe2\x82\xac \xf0\x9f\x98\x80"),
              "Gr\xc3\xbc\xc3\x9f\xe2\x82\xac \xf0\x9f\x98\x80");
    EXPECT_EQ(oneLine(""), "");
}

TEST(OneLine, ReplacesWhatSteersTheTerminal) {
    EXPECT_EQ(oneLine("a\x1b[31mb\nc\rd\te\x7f"
                      "f"),
              "a [31mb c d e f");
    EXPECT_EQ(oneLine("a\xc2\x9b"
                      "31mb"),
              "a 31mb")
        << "C1: one character that starts a command";
    EXPECT_EQ(oneLine("a\xe2\x80\xae"
                      "b\xe2\x81\xa6"
                      "c\xe2\x80\x8f"
                      "d\xd8\x9c"
                      "e\xe2\x80\xa8"
                      "f"),
              "a b c d e f");
    EXPECT_EQ(oneLine("end \n"), "end");
}

TEST(OneLine, MarksBytesThatAreNoText) {
    EXPECT_EQ(oneLine("a\xff\xc3"), "a??");
    EXPECT_EQ(oneLine("\xc0\xaf"), "??") << "too long a form";
    EXPECT_EQ(oneLine("\xed\xa0\x80"), "???") << "a surrogate";
    EXPECT_EQ(oneLine("\xf4\x90\x80\x80"), "????") << "beyond U+10FFFF";
    EXPECT_EQ(oneLine(std::string_view("a\0b", 3)), "a b");
}

TEST(OneLine, CutsBetweenCharacters) {
    EXPECT_EQ(oneLine("abcd", 4), "abcd");
    EXPECT_EQ(oneLine("abcde", 4), "abcd...");
    EXPECT_EQ(oneLine("abc\xe2\x82\xac", 4), "abc...");
    EXPECT_EQ(oneLine("abc\xe2\x82\xac", 6), "abc\xe2\x82\xac");
}

}  // namespace
}  // namespace licht
