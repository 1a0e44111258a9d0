// --denoise oidn where the program was made without OpenImageDenoise.
#include <gtest/gtest.h>

#include "run_program.h"

namespace licht::test {
namespace {

TEST(WithoutOidn, OneLineSaysSo) {
    const ScratchFolder folder;
    const Outcome outcome =
        runLicht(folder, {"render", "cornell", "--denoise", "oidn", "-o", "a.png", "--report", "a.json"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.err, "licht: --denoise 'oidn': this build has no OpenImageDenoise\n");
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(folder.contents().empty());
}

TEST(WithoutOidn, HelpDoesNotOfferIt) {
    const ScratchFolder folder;
    const Outcome outcome = runLicht(folder, {"render", "--help"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.out.find("oidn"), std::string::npos);
}

}  // namespace
}  // namespace licht::test
