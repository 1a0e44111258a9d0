#include "samples/licht/frame_pattern.h"

#include <gtest/gtest.h>

#include "licht/core/error.h"

namespace licht {
namespace {

TEST(FramePattern, NumbersAsWideAsItSays) {
    EXPECT_EQ(FramePattern("f-%d.exr").of(0), "f-0.exr");
    EXPECT_EQ(FramePattern("f-%d.exr").of(1234567), "f-1234567.exr");
    EXPECT_EQ(FramePattern("f-%04d.exr").of(7), "f-0007.exr");
    EXPECT_EQ(FramePattern("f-%04d.exr").of(12345), "f-12345.exr");
    EXPECT_EQ(FramePattern("%09d.png").of(4294967295U), "4294967295.png");
    EXPECT_EQ(FramePattern("%01ddays.png").of(3), "3days.png");
}

TEST(FramePattern, BracesAreNoFormat) {
    EXPECT_EQ(FramePattern("{}-%d-{0}.png").of(5), "{}-5-{0}.png");
}

TEST(FramePattern, FoldersKeepTheirNames) {
    EXPECT_EQ(FramePattern("100%/%s/f-%02d.png").of(3), "100%/%s/f-03.png");
    EXPECT_EQ(FramePattern("/there/%d.png").of(3), "/there/3.png");
}

TEST(FramePattern, HasOneNumber) {
    for (const char* bad :
         {"f.png",     "%d-%d.png", "f-%s.png", "f-%.png",  "%",       "f%",       "%5d.png", "%0d.png",
          "%010d.png", "%00d.png",  "%D.png",   "%04i.png", "%%d.png", "%d%%.png", "%04",     "%0",
          "% d.png",   "%+d.png",   "%-4d.png", "%ld.png",  "",        "%d/f.png", "%d/"})
        EXPECT_THROW(FramePattern{bad}, InputError) << bad;
    try {
        const FramePattern pattern("out/f-%s.png");
        FAIL() << "no error";
    } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()).rfind("out/f-%s.png: ", 0), 0U) << error.what();
    }
}

}  // namespace
}  // namespace licht
