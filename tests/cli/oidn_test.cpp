// --denoise oidn where the program was made with OpenImageDenoise: what it takes, what it leaves, what it
// says.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "licht/core/file.h"
#include "licht/image/exr.h"
#include "licht/image/files.h"
#include "licht/measure/metrics.h"
#include "licht/shared/transfer.h"
#include "run_program.h"

namespace licht::test {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;

void runWell(const ScratchFolder& folder, Words arguments) {
    arguments.emplace_back("--quiet");
    const Outcome outcome = runLicht(folder, arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
}

ExrPicture exrOf(const ScratchFolder& folder, const std::string& name) {
    return readExr(folder.path() / name);
}

Image colourOf(const ExrPicture& picture, const std::string& layer = "") {
    Image image(picture.width, picture.height, 3);
    const char* names = "RGB";
    for (std::size_t c = 0; c < 3; ++c) {
        const ExrChannel* channel = picture.find(layer + names[c]);
        EXPECT_NE(channel, nullptr) << layer << names[c];
        if (channel == nullptr) continue;
        for (std::size_t i = 0; i < channel->values.size(); ++i) image.texels[3 * i + c] = channel->values[i];
    }
    return image;
}

bool sameBits(const std::vector<float>& a, const std::vector<float>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

TEST(Oidn, TakesNoiseAndLeavesTheRest) {
    const ScratchFolder folder;
    const Words picture{"render", "cornell", "--size", "64x64", "--spp"};
    const auto drawn = [&](Words with) {
        with.insert(with.begin(), picture.begin(), picture.end());
        runWell(folder, with);
    };
    drawn({"256", "--seed", "77", "-o", "truth.exr"});
    drawn({"4", "--aov", "all", "-o", "raw.exr", "-o", "raw.png"});
    drawn({"4", "--aov", "all", "--denoise", "oidn", "-o", "a.exr", "-o", "a.png", "--unfiltered",
           "before.png", "--report", "a.json"});

    const ExrPicture raw = exrOf(folder, "raw.exr");
    const ExrPicture filtered = exrOf(folder, "a.exr");
    const Image truth = colourOf(exrOf(folder, "truth.exr"));
    EXPECT_LT(relMse(colourOf(filtered), truth), relMse(colourOf(raw), truth));
    EXPECT_TRUE(sameBits(colourOf(filtered, "unfiltered.").texels, colourOf(raw).texels));
    EXPECT_EQ(folder.read("before.png"), folder.read("raw.png"));
    EXPECT_NE(folder.read("a.png"), folder.read("raw.png"));

    // Everything that is not the picture's colour is as it was; of its error nothing is said.
    for (const ExrChannel& channel : raw.channels) {
        if (channel.name.size() == 1 && channel.name != "A" && channel.name != "Z") continue;
        const ExrChannel* kept = filtered.find(channel.name);
        if (channel.name.starts_with("variance")) {
            EXPECT_EQ(kept, nullptr) << channel.name;
        } else {
            ASSERT_NE(kept, nullptr) << channel.name;
            EXPECT_TRUE(sameBits(kept->values, channel.values)) << channel.name;
        }
    }
    const std::pair<std::string, std::string> told{"licht.denoise", "oidn"};
    EXPECT_EQ(std::count(filtered.attributes.begin(), filtered.attributes.end(), told), 1);
    const json report = json::parse(folder.read("a.json"));
    EXPECT_TRUE(report.at("relative_error").is_null());
    EXPECT_GT(report.at("unfiltered_relative_error").get<double>(), 0.0);
    EXPECT_TRUE(report.at("declared_bias").at("denoise").at("relative_bias").is_null());
    EXPECT_EQ(report.at("settings").at("denoise"), "oidn");
}

TEST(Oidn, ThePictureOnADisplayIsThatOfTheFile) {
    const ScratchFolder folder;
    runWell(folder, {"render", "cornell", "--size", "32x32", "--spp", "2", "--denoise", "oidn", "--tonemap",
                     "none", "--exposure", "0", "-o", "a.exr", "-o", "a.png"});
    const Image linear = colourOf(exrOf(folder, "a.exr"));
    const EncodedImage png = decodeImage(readFile(folder.path() / "a.png"), "a.png");
    for (std::size_t i = 0; i < linear.texels.size(); ++i) {
        const float shown = 255.0F * srgbFromLinear(std::clamp(linear.texels[i], 0.0F, 1.0F));
        // Half a code by rounding, and the device's own power function.
        ASSERT_NEAR(static_cast<float>(png.bytes[4 * (i / 3) + i % 3]), shown, 0.6F) << i;
    }
}

/// Of the furnace without chance, what the filter makes of each value, as a share of it.
std::vector<double> sharesLeft(const char* bounces) {
    const ScratchFolder folder;
    runWell(folder, {"render", "furnace", "--size", "64x64", "--spp", "4", "--bounces", bounces, "--roulette",
                     "99", "--denoise", "oidn", "--aov", "unfiltered", "-o", "a.exr"});
    const ExrPicture picture = exrOf(folder, "a.exr");
    const std::vector<float> before = colourOf(picture, "unfiltered.").texels;
    const std::vector<float> after = colourOf(picture).texels;
    std::vector<double> shares;
    for (std::size_t i = 0; i < after.size(); ++i)
        shares.push_back(static_cast<double>(after[i]) / static_cast<double>(before[i]));
    return shares;
}

// A network promises nothing of a pixel. What it does to equal ones it does at every brightness, but for the
// rounding of its floats, and their mean stays within one of a display's steps.
TEST(Oidn, EqualRadianceStaysEqual) {
    const std::vector<double> dark = sharesLeft("0");
    const std::vector<double> bright = sharesLeft("2");
    double sum = 0.0;
    for (std::size_t i = 0; i < dark.size(); ++i) {
        ASSERT_NEAR(dark[i], bright[i], 1e-4) << i;
        sum += dark[i];
    }
    EXPECT_NEAR(sum / static_cast<double>(dark.size()), 1.0, 1.0 / 255.0);
}

TEST(Oidn, EveryFrameOfAPathIsFiltered) {
    const ScratchFolder folder;
    const Words path{"render", "cornell", "--size", "32x32", "--path", "orbit", "--frames", "2"};
    const auto drawn = [&](Words with) {
        with.insert(with.begin(), path.begin(), path.end());
        runWell(folder, with);
    };
    drawn({"-o", "raw-%d.exr"});
    drawn({"--denoise", "oidn", "--aov", "unfiltered", "-o", "a-%d.exr", "--report", "a.json"});
    for (const char* frame : {"0", "1"}) {
        const Image raw = colourOf(exrOf(folder, std::string("raw-") + frame + ".exr"));
        const ExrPicture filtered = exrOf(folder, std::string("a-") + frame + ".exr");
        EXPECT_TRUE(sameBits(colourOf(filtered, "unfiltered.").texels, raw.texels)) << frame;
        EXPECT_GT(relMse(colourOf(filtered), raw), 0.0) << frame;
    }
    const json report = json::parse(folder.read("a.json"));
    for (const json& frame : report.at("sequence").at("frames"))
        EXPECT_TRUE(frame.at("relative_error").is_null());
}

TEST(Oidn, StandsBesideTheOthersInMotion) {
    const ScratchFolder folder;
    const Outcome outcome =
        runLicht(folder, {"accuracy", "cornell", "--temporal", "--size", "32x32", "--frames", "2",
                          "--reference-spp", "64", "--json", "a.json", "--quiet"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json modes = json::parse(folder.read("a.json")).at("modes");
    EXPECT_EQ(modes.back().at("mode"), "oidn");
    EXPECT_LT(modes.back().at("relmse").get<double>(), modes.front().at("relmse").get<double>());
}

TEST(Oidn, WhoAsksForItsErrorIsRefused) {
    const ScratchFolder folder;
    for (const Words& asked : {Words{"--error", "0.1"}, Words{"--aov", "albedo,variance", "-o", "a.exr"}}) {
        Words words{"render", "cornell", "--denoise", "oidn"};
        words.insert(words.end(), asked.begin(), asked.end());
        const Outcome outcome = runLicht(folder, words);
        EXPECT_EQ(outcome.exit_code, 2);
        ASSERT_EQ(outcome.errorLines().size(), 1U) << outcome.err;
        EXPECT_NE(outcome.err.find(asked[0]), std::string::npos) << outcome.err;
    }
    EXPECT_TRUE(folder.contents().empty());
}

}  // namespace
}  // namespace licht::test
