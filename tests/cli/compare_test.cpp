// licht compare: its numbers, its files, and what it refuses.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "licht/image/exr.h"
#include "run_program.h"

namespace licht::test {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;

/// R, G and B of those values in every pixel; with `variance`, that layer too.
ExrPicture plain(int width, int height, const std::vector<float>& rgb, float variance = -1.0F) {
    ExrPicture picture;
    picture.width = width;
    picture.height = height;
    const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    const std::vector<std::string> names{"R", "G", "B"};
    for (std::size_t c = 0; c < names.size(); ++c) {
        picture.channels.push_back({names[c], std::vector<float>(pixels, rgb[c])});
        if (variance >= 0.0F)
            picture.channels.push_back({"variance." + names[c], std::vector<float>(pixels, variance)});
    }
    return picture;
}

void setRed(ExrPicture& picture, std::size_t pixel, float value) {
    for (ExrChannel& channel : picture.channels)
        if (channel.name == "R") channel.values[pixel] = value;
}

class Compare : public testing::Test {
protected:
    void write(const std::string& name, const ExrPicture& picture) const {
        writeExr(folder.path() / name, picture);
    }
    [[nodiscard]] Outcome run(const Words& arguments) const {
        Words words{"compare"};
        words.insert(words.end(), arguments.begin(), arguments.end());
        return runLicht(folder, words);
    }
    void refuses(const Words& arguments, const std::string& says) const {
        const Words before = folder.contents();
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exit_code, 2);
        EXPECT_EQ(outcome.out, "");
        ASSERT_EQ(outcome.errorLines().size(), 1U) << outcome.err;
        EXPECT_EQ(outcome.err.rfind("licht: ", 0), 0U) << outcome.err;
        EXPECT_NE(outcome.err.find(says), std::string::npos) << outcome.err;
        EXPECT_EQ(folder.contents(), before);
    }

    const ScratchFolder folder;
};

TEST_F(Compare, MeasuresByHandMadeNumbers) {
    write("reference.exr", plain(50, 40, {1.0F, 1.0F, 1.0F}));
    ExrPicture picture = plain(50, 40, {1.0F, 1.5F, 1.0F});
    picture.attributes = {{"licht.spp", "16"}, {"licht.seconds", "0.250"}};
    setRed(picture, 7, 101.0F);
    setRed(picture, 8, 2.0F);
    setRed(picture, 9, 3.0F);
    write("picture.exr", picture);
    const Outcome outcome = run({"reference.exr", "picture.exr", "reference.exr", "--json", "out.json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("picture.exr"), std::string::npos) << outcome.out;
    const json report = json::parse(folder.read("out.json"));
    EXPECT_EQ(report.at("width"), 50);
    EXPECT_EQ(report.at("reference").at("file"), "reference.exr");
    ASSERT_EQ(report.at("pictures").size(), 2U);
    const json& first = report.at("pictures")[0];
    EXPECT_EQ(first.at("file"), "picture.exr");
    EXPECT_EQ(first.at("samples"), 16);
    EXPECT_EQ(first.at("seconds"), 0.25);
    // 2000 pixels: green is off by one half in all of them, red by 100, 1 and 2 in three; the reference and
    // its mean are 1. The worst two pixels are those of 100 and 2. Sums of doubles: relative 1e-12.
    const double squares = 0.25 * 2000.0 + 1e4 + 1.0 + 4.0;
    EXPECT_NEAR(first.at("mse").get<double>(), squares / 6000.0, 1e-12);
    EXPECT_NEAR(first.at("rel_mse").get<double>(), squares / 6000.0 / 1.01, 1e-12);
    EXPECT_NEAR(first.at("trimmed_rel_mse").get<double>(), (0.25 * 1998.0 + 1.0) / (3.0 * 1998.0) / 1.01,
                1e-12);
    EXPECT_EQ(first.at("largest_difference"), 100.0);
    EXPECT_NEAR(first.at("mean_ratio")[0].get<double>(), 1.0 + 103.0 / 2000.0, 1e-12);
    EXPECT_NEAR(first.at("mean_ratio")[1].get<double>(), 1.5, 1e-12);
    EXPECT_EQ(first.at("mean_ratio")[2], 1.0);
    EXPECT_TRUE(first.at("z_test").is_null());
    EXPECT_EQ(first.at("flip"), 0.0) << "all of it is white to a display";
    const json& same = report.at("pictures")[1];
    EXPECT_EQ(same.at("rel_mse"), 0.0);
    EXPECT_EQ(same.at("flip"), 0.0);
    EXPECT_TRUE(same.at("samples").is_null());
}

TEST_F(Compare, TestsBlocksWhereBothKnowTheirVariance) {
    write("reference.exr", plain(32, 16, {1.0F, 1.0F, 1.0F}, 0.01F));
    // Each pixel is off by 0.05, a third of a standard deviation: 5.7 of them over a block of 256, p
    // = 1.5e-8.
    write("biased.exr", plain(32, 16, {1.05F, 1.0F, 1.0F}, 0.01F));
    write("near.exr", plain(32, 16, {1.005F, 1.0F, 1.0F}, 0.01F));
    write("blind.exr", plain(32, 16, {1.05F, 1.0F, 1.0F}));
    const Outcome outcome =
        run({"reference.exr", "biased.exr", "near.exr", "blind.exr", "--json", "out.json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("biased.exr (differs)"), std::string::npos) << outcome.out;
    EXPECT_EQ(outcome.out.find("near.exr (differs)"), std::string::npos) << outcome.out;
    const json pictures = json::parse(folder.read("out.json")).at("pictures");
    EXPECT_EQ(pictures[0].at("z_test").at("agree"), false);
    EXPECT_EQ(pictures[0].at("z_test").at("pixel_pass_share"), 1.0);
    EXPECT_LT(pictures[0].at("z_test").at("smallest_block_p").get<double>(), 1e-7);
    EXPECT_EQ(pictures[1].at("z_test").at("agree"), true);
    EXPECT_TRUE(pictures[2].at("z_test").is_null());
}

TEST_F(Compare, SeesDifferencesAsADisplayShowsThem) {
    write("white.exr", plain(20, 20, {1.0F, 1.0F, 1.0F}));
    write("black.exr", plain(20, 20, {0.0F, -1.0F, 0.0F}));
    write("grey.exr", plain(20, 20, {0.21404114F, 0.21404114F, 0.21404114F}));
    write("lamp.exr", plain(20, 20, {7.0F, 1.0F, 50.0F}));
    const Outcome outcome = run({"white.exr", "black.exr", "grey.exr", "lamp.exr", "--json", "out.json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find(" FLIP "), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find(" 0.96738 "), std::string::npos) << outcome.out;
    const json pictures = json::parse(folder.read("out.json")).at("pictures");
    // A difference d of CIELAB's lightness gives d^0.7 = e, and an error of 0.95 e / k up to k = 16.510439,
    // 0.4 of that of green and blue, and 0.05 of the rest of it above (tests/unit/flip_test.cpp). Black and
    // white: d = 100. Linear 0.21404114 is the code 0.5: d = 116 - 116 cbrt(0.21404114). Tolerance: three
    // roundings of floats near one, 6e-8 each, by a slope of 116 / 3 * 0.7 / d below one.
    const double knee = 16.510439;
    const double grey = 116.0 - 116.0 * std::cbrt(0.21404114);
    EXPECT_NEAR(pictures[0].at("flip").get<double>(),
                0.95 + 0.05 * (std::pow(100.0, 0.7) - knee) / (1.5 * knee), 2e-7);
    EXPECT_NEAR(pictures[1].at("flip").get<double>(), 0.95 * std::pow(grey, 0.7) / knee, 2e-7);
    // Both are white there, to what the curve's own roundings make of one.
    EXPECT_EQ(pictures[2].at("flip"), 0.0);
    EXPECT_GT(pictures[2].at("rel_mse").get<double>(), 1.0);
}

TEST_F(Compare, FilteredPicturesHaveNoZTest) {
    ExrPicture picture = plain(32, 16, {1.05F, 1.0F, 1.0F}, 0.01F);
    write("reference.exr", plain(32, 16, {1.0F, 1.0F, 1.0F}, 0.01F));
    picture.attributes = {{"licht.denoise", "none"}};
    write("samples.exr", picture);
    picture.attributes = {{"licht.denoise", "spatiotemporal"}};
    write("filtered.exr", picture);
    const std::string why = "depend on each other";

    const Outcome samples = run({"reference.exr", "samples.exr", "--json", "samples.json"});
    ASSERT_EQ(samples.exit_code, 0) << samples.err;
    EXPECT_EQ(samples.out.find("filtered"), std::string::npos) << samples.out;
    const json all_samples = json::parse(folder.read("samples.json"));
    EXPECT_EQ(all_samples.at("reference").at("filtered"), false);
    EXPECT_EQ(all_samples.at("pictures")[0].at("filtered"), false);
    EXPECT_EQ(all_samples.at("pictures")[0].at("z_test").at("agree"), false);

    const Outcome one = run({"reference.exr", "samples.exr", "filtered.exr", "--json", "one.json"});
    ASSERT_EQ(one.exit_code, 0) << one.err;
    EXPECT_NE(one.out.find("samples.exr (differs)\n"), std::string::npos) << one.out;
    EXPECT_NE(one.out.find("         -         -  filtered.exr (filtered)\n"), std::string::npos) << one.out;
    EXPECT_NE(one.out.find(why), std::string::npos) << one.out;
    const json pictures = json::parse(folder.read("one.json")).at("pictures");
    EXPECT_FALSE(pictures[0].at("z_test").is_null());
    EXPECT_EQ(pictures[1].at("filtered"), true);
    EXPECT_TRUE(pictures[1].at("z_test").is_null());

    const Outcome truth = run({"filtered.exr", "samples.exr", "--json", "truth.json"});
    ASSERT_EQ(truth.exit_code, 0) << truth.err;
    EXPECT_NE(truth.out.find(", filtered\n"), std::string::npos) << truth.out;
    EXPECT_NE(truth.out.find(why), std::string::npos) << truth.out;
    const json filtered_truth = json::parse(folder.read("truth.json"));
    EXPECT_EQ(filtered_truth.at("reference").at("filtered"), true);
    EXPECT_EQ(filtered_truth.at("pictures")[0].at("filtered"), false);
    EXPECT_TRUE(filtered_truth.at("pictures")[0].at("z_test").is_null());
}

TEST_F(Compare, KnowsWhatTheFilterDrew) {
    for (const char* how : {"none", "spatiotemporal", "temporal"}) {
        const Outcome drawn =
            runLicht(folder, {"render", "furnace", "--size", "16x16", "--spp", "4", "--aov", "variance",
                              "--denoise", how, "-o", std::string(how) + ".exr", "--quiet"});
        ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    }
    const Outcome outcome =
        run({"none.exr", "none.exr", "spatiotemporal.exr", "temporal.exr", "--json", "out.json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json pictures = json::parse(folder.read("out.json")).at("pictures");
    EXPECT_EQ(pictures[0].at("filtered"), false);
    EXPECT_FALSE(pictures[0].at("z_test").is_null());
    EXPECT_EQ(pictures[1].at("filtered"), true);
    EXPECT_TRUE(pictures[1].at("z_test").is_null());
    // A still has no earlier views.
    EXPECT_EQ(pictures[2].at("filtered"), false);
    EXPECT_EQ(pictures[2].at("rel_mse"), 0.0);
}

TEST_F(Compare, RefusesWhatItCannotCompare) {
    write("reference.exr", plain(8, 8, {1.0F, 1.0F, 1.0F}));
    write("wide.exr", plain(9, 8, {1.0F, 1.0F, 1.0F}));
    ExrPicture grey = plain(8, 8, {1.0F, 1.0F, 1.0F});
    grey.channels.resize(1);
    write("grey.exr", grey);
    ExrPicture broken = plain(8, 8, {1.0F, 1.0F, 1.0F});
    setRed(broken, 5, std::numeric_limits<float>::quiet_NaN());
    setRed(broken, 6, std::numeric_limits<float>::infinity());
    write("broken.exr", broken);
    folder.write("notes.exr", "this is no picture");
    refuses({}, "REFERENCE");
    refuses({"reference.exr"}, "PICTURE");
    refuses({"missing.exr", "reference.exr"}, "missing.exr");
    refuses({"reference.exr", "missing.exr"}, "missing.exr");
    refuses({"notes.exr", "reference.exr"}, "notes.exr: is no OpenEXR file");
    refuses({"reference.exr", "wide.exr"}, "wide.exr: is 9x8, but reference.exr is 8x8");
    refuses({"reference.exr", "grey.exr"}, "grey.exr: has no channels R, G and B");
    refuses({"broken.exr", "reference.exr"}, "broken.exr: 2 of its values are no finite numbers");
    refuses({"reference.exr", "wide.exr", "--json", "out.json"}, "wide.exr");
    refuses({"reference.exr", "reference.exr", "--json", "nowhere/out.json"}, "nowhere");
    refuses({"reference.exr", "reference.exr", "--frobnicate"}, "--frobnicate");
}

TEST_F(Compare, AsksForTheMemoryThatItTakes) {
    // FLIP takes 92 bytes a pixel, more than all else together; each file's colours are 12.
    write("large.exr", plain(3000, 1000, {1.0F, 1.0F, 1.0F}));
    refuses({"large.exr", "large.exr", "--memory-limit", "260M"}, "large.exr: FLIP takes about 263 MiB");
}

TEST_F(Compare, HelpNamesIt) {
    EXPECT_NE(runLicht(folder, {"--help"}).out.find("compare"), std::string::npos);
    const std::string help = run({"--help"}).out;
    for (const char* word : {"relMSE", "FLIP", "filtered"})
        EXPECT_NE(help.find(word), std::string::npos) << word << "\n" << help;
}

}  // namespace
}  // namespace licht::test
