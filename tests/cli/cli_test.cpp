// The command at work: what it writes, when it stops, what it reports.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstring>
#include <nlohmann/json.hpp>

#include "licht/core/file.h"
#include "licht/image/exr.h"
#include "licht/image/files.h"
#include "run_program.h"

namespace licht::test {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;

/// Runs and demands success without a word from the validation layer.
Outcome runWell(const ScratchFolder& folder, const Words& arguments) {
    Outcome outcome = runLicht(folder, arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err.find("validation:"), std::string::npos) << outcome.err;
    return outcome;
}

std::vector<std::string> channelNames(const ExrPicture& picture) {
    std::vector<std::string> names;
    for (const ExrChannel& channel : picture.channels) names.push_back(channel.name);
    std::sort(names.begin(), names.end());
    return names;
}

bool allFinite(const ExrPicture& picture, const std::string& channel) {
    const ExrChannel* found = picture.find(channel);
    return found != nullptr &&
           std::all_of(found->values.begin(), found->values.end(), [](float v) { return std::isfinite(v); });
}

bool sameBits(const ExrPicture& a, const ExrPicture& b) {
    return a.channels.size() == b.channels.size() &&
           std::equal(a.channels.begin(), a.channels.end(), b.channels.begin(),
                      [](const ExrChannel& x, const ExrChannel& y) {
                          return x.name == y.name && x.values.size() == y.values.size() &&
                                 std::memcmp(x.values.data(), y.values.data(),
                                             x.values.size() * sizeof(float)) == 0;
                      });
}

std::string attribute(const ExrPicture& picture, const std::string& name) {
    for (const auto& [key, value] : picture.attributes)
        if (key == name) return value;
    return "(none)";
}

class BuiltinTest : public testing::TestWithParam<const char*> {};

TEST_P(BuiltinTest, WritesPngAndExr) {
    const ScratchFolder folder;
    runWell(folder, {"render", GetParam(), "--size", "32x24", "--spp", "4", "-o", "a.png", "-o", "a.exr"});
    EXPECT_EQ(folder.contents(), (Words{"a.exr", "a.png"}));
    const EncodedImage png = decodeImage(readFile(folder.path() / "a.png"), "a.png");
    EXPECT_EQ(png.width, 32);
    EXPECT_EQ(png.height, 24);
    const ExrPicture exr = readExr(folder.path() / "a.exr");
    EXPECT_EQ(exr.width, 32);
    EXPECT_EQ(exr.height, 24);
    EXPECT_EQ(channelNames(exr), (Words{"A", "B", "G", "R"}));
    for (const char* channel : {"R", "G", "B", "A"}) EXPECT_TRUE(allFinite(exr, channel)) << channel;
    const std::vector<float>& red = exr.find("R")->values;
    EXPECT_TRUE(std::any_of(red.begin(), red.end(), [](float v) { return v > 0.0F; }))
        << "the picture is black";
}

INSTANTIATE_TEST_SUITE_P(Cli, BuiltinTest, testing::Values("empty", "cornell", "furnace"),
                         [](const testing::TestParamInfo<const char*>& scene) {
                             return std::string(scene.param);
                         });

TEST(Render, DefaultOutputIsNamedAfterTheScene) {
    const ScratchFolder folder;
    const Outcome outcome = runWell(folder, {"render", "empty", "--size", "8x8", "--spp", "1"});
    EXPECT_EQ(folder.contents(), Words{"empty.png"});
    EXPECT_NE(outcome.out.find("wrote empty.png"), std::string::npos) << outcome.out;
}

TEST(Render, QuietSaysNothing) {
    const ScratchFolder folder;
    const Outcome outcome = runWell(folder, {"render", "empty", "--size", "8x8", "--spp", "1", "--quiet"});
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "");
}

TEST(Render, DarkSceneGetsANeutralSkyAndSaysSo) {
    const ScratchFolder folder;
    const Outcome outcome = runWell(
        folder, {"render", "empty", "--size", "8x8", "--spp", "1", "-o", "a.exr", "--report", "report.json"});
    EXPECT_NE(outcome.err.find("neutral sky"), std::string::npos) << outcome.err;
    const json report = json::parse(folder.read("report.json"));
    EXPECT_NE(report["notes"].dump().find("neutral sky"), std::string::npos) << report["notes"];
    const ExrPicture picture = readExr(folder.path() / "a.exr");
    // One sample of a constant: a filter's four weights add up to 1 within a few roundings of 2^-24 each.
    constexpr float kTolerance = 8.0F / 16777216.0F;
    for (const char* channel : {"R", "G", "B"})
        for (const float value : picture.find(channel)->values) EXPECT_NEAR(value, 1.0F, kTolerance);
}

TEST(Render, BackgroundIsTheSkyAskedFor) {
    const ScratchFolder folder;
    const Outcome outcome = runWell(
        folder, {"render", "empty", "--size", "8x8", "--spp", "1", "-o", "a.exr", "--background", "0.5,2,0"});
    EXPECT_EQ(outcome.err.find("neutral sky"), std::string::npos) << outcome.err;
    const ExrPicture picture = readExr(folder.path() / "a.exr");
    constexpr float kTolerance = 8.0F / 16777216.0F;  // as above, relative
    EXPECT_NEAR(picture.find("R")->values.front(), 0.5F, 0.5F * kTolerance);
    EXPECT_NEAR(picture.find("G")->values.front(), 2.0F, 2.0F * kTolerance);
    EXPECT_EQ(picture.find("B")->values.front(), 0.0F);
}

TEST(Render, ReportHasEveryKeyWithSaneValues) {
    const ScratchFolder folder;
    runWell(folder, {"render", "cornell", "--size", "32x16", "--spp", "4", "--seed", "7", "--bounces", "3",
                     "-o", "a.exr", "--report", "report.json"});
    const json report = json::parse(folder.read("report.json"));
    EXPECT_EQ(report.at("scene"), "cornell");
    EXPECT_NE(report.at("device"), "");
    EXPECT_NE(report.at("driver"), "");
    EXPECT_EQ(report.at("size"), json({32, 16}));
    EXPECT_EQ(report.at("spp"), 4);
    EXPECT_EQ(report.at("seed"), 7);
    EXPECT_EQ(report.at("bounces"), 3);
    EXPECT_EQ(report.at("queues"), false);  // too short a run
    EXPECT_EQ(report.at("stopped_by"), "spp");
    EXPECT_EQ(report.at("interrupted"), false);
    EXPECT_EQ(report.at("outputs"), json({"a.exr"}));
    EXPECT_TRUE(report.at("camera").is_string());
    EXPECT_TRUE(report.at("notes").is_array());
    const json& seconds = report.at("seconds");
    for (const char* key : {"load", "bvh", "upload", "pipelines", "first_image", "render", "total"}) {
        EXPECT_GE(seconds.at(key).get<double>(), 0.0) << key;
        EXPECT_LE(seconds.at(key).get<double>(), seconds.at("total").get<double>()) << key;
    }
    EXPECT_GE(seconds.at("first_image").get<double>(), seconds.at("pipelines").get<double>());
    EXPECT_FALSE(report.at("passes").empty());
    for (const auto& [name, pass_seconds] : report.at("passes").items())
        EXPECT_GE(pass_seconds.get<double>(), 0.0) << name;
    EXPECT_EQ(report.at("rays").at("primary"), 32 * 16 * 4);
    EXPECT_GT(report.at("rays").at("bounce").get<std::uint64_t>(), 0U);
    EXPECT_GT(report.at("rays").at("shadow").get<std::uint64_t>(), 0U);
    EXPECT_GT(report.at("rays_per_second").get<double>(), 0.0);
    EXPECT_GT(report.at("relative_error").get<double>(), 0.0);
    EXPECT_EQ(report.at("nonfinite_samples"), 0);
    EXPECT_TRUE(report.at("effects").is_array());
    EXPECT_GT(report.at("memory").at("host_peak_bytes").get<std::uint64_t>(), 0U);
    EXPECT_GT(report.at("memory").at("device_bytes").get<std::uint64_t>(), 0U);
}

TEST(Render, ErrorIsUnknownAfterOneSample) {
    const ScratchFolder folder;
    runWell(folder, {"render", "cornell", "--size", "8x8", "--spp", "1", "--report", "report.json"});
    EXPECT_TRUE(json::parse(folder.read("report.json")).at("relative_error").is_null());
}

TEST(Render, AllLayersUnderTheirNames) {
    const ScratchFolder folder;
    runWell(folder, {"render", "cornell", "--size", "16x16", "--spp", "3", "-o", "a.exr", "--aov", "all"});
    const ExrPicture picture = readExr(folder.path() / "a.exr");
    EXPECT_EQ(channelNames(picture),
              (Words{"A", "B", "G", "N.X", "N.Y", "N.Z", "R", "Z", "albedo.B", "albedo.G", "albedo.R",
                     "motion.X", "motion.Y", "sampleCount", "variance.B", "variance.G", "variance.R"}));
    for (const float count : picture.find("sampleCount")->values) EXPECT_EQ(count, 3.0F);
    for (const char* channel : {"variance.R", "albedo.G"})
        for (const float value : picture.find(channel)->values) EXPECT_GE(value, 0.0F) << channel;
    EXPECT_EQ(attribute(picture, "licht.scene"), "cornell");
    EXPECT_EQ(attribute(picture, "licht.spp"), "3");
    EXPECT_EQ(attribute(picture, "licht.bounces"), "8");
    EXPECT_NE(attribute(picture, "licht.device"), "(none)");
}

TEST(Render, SomeLayersOnly) {
    const ScratchFolder folder;
    runWell(folder,
            {"render", "cornell", "--size", "16x16", "--spp", "1", "-o", "a.exr", "--aov", "depth,variance"});
    EXPECT_EQ(channelNames(readExr(folder.path() / "a.exr")),
              (Words{"A", "B", "G", "R", "Z", "variance.B", "variance.G", "variance.R"}));
}

TEST(Render, SameSeedSameBitsOtherSeedOthers) {
    const ScratchFolder folder;
    const auto picture = [&folder](const char* seed, const char* file) {
        runWell(folder, {"render", "cornell", "--size", "24x24", "--spp", "5", "--seed", seed, "-o", file,
                         "--aov", "variance"});
        return readExr(folder.path() / file);
    };
    const ExrPicture first = picture("11", "a.exr");
    EXPECT_TRUE(sameBits(first, picture("11", "b.exr")));
    EXPECT_FALSE(sameBits(first, picture("12", "c.exr")));
}

TEST(Render, TimeStops) {
    const ScratchFolder folder;
    runWell(folder, {"render", "cornell", "--size", "16x16", "--time", "0.5", "--report", "report.json"});
    const json report = json::parse(folder.read("report.json"));
    EXPECT_EQ(report.at("stopped_by"), "time");
    EXPECT_GE(report.at("seconds").at("render").get<double>(), 0.5);
    EXPECT_GE(report.at("spp").get<int>(), 1);
}

TEST(Render, ErrorStops) {
    const ScratchFolder folder;
    runWell(folder, {"render", "cornell", "--size", "16x16", "--error", "0.2", "--report", "report.json"});
    const json report = json::parse(folder.read("report.json"));
    EXPECT_EQ(report.at("stopped_by"), "error");
    EXPECT_LE(report.at("relative_error").get<double>(), 0.2);
}

TEST(Render, FirstLimitWins) {
    const ScratchFolder folder;
    runWell(folder, {"render", "cornell", "--size", "16x16", "--error", "1e-9", "--time", "1000", "--spp",
                     "3", "--report", "report.json"});
    const json report = json::parse(folder.read("report.json"));
    EXPECT_EQ(report.at("stopped_by"), "spp");
    EXPECT_EQ(report.at("spp"), 3);
}

class InterruptTest : public testing::TestWithParam<int> {};

TEST_P(InterruptTest, WritesWhatIsThere) {
    const ScratchFolder folder;
    RunningProgram program(folder, {"render", "cornell", "--size", "64x64", "--spp", "4294967295", "-o",
                                    "a.exr", "-o", "a.png", "--report", "report.json"});
    ASSERT_TRUE(program.waitUntilCatches(GetParam()));
    program.send(GetParam());
    const Outcome outcome = program.wait();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("interrupted"), std::string::npos) << outcome.err;
    EXPECT_EQ(folder.contents(), (Words{"a.exr", "a.png", "report.json"}));
    const json report = json::parse(folder.read("report.json"));
    EXPECT_EQ(report.at("interrupted"), true);
    EXPECT_EQ(report.at("stopped_by"), "interrupt");
    EXPECT_GE(report.at("spp").get<int>(), 1);
    EXPECT_TRUE(allFinite(readExr(folder.path() / "a.exr"), "R"));
    EXPECT_EQ(decodeImage(readFile(folder.path() / "a.png"), "a.png").width, 64);
}

INSTANTIATE_TEST_SUITE_P(Cli, InterruptTest, testing::Values(SIGINT, SIGTERM),
                         [](const testing::TestParamInfo<int>& sent) {
                             return sent.param == SIGINT ? "Int" : "Term";
                         });

TEST(Info, TextAndJsonOfEveryBuiltin) {
    const ScratchFolder folder;
    for (const char* scene : {"cornell", "furnace", "gallery", "empty"}) {
        EXPECT_NE(runWell(folder, {"info", scene}).out, "");
        EXPECT_TRUE(json::parse(runWell(folder, {"info", scene, "--json"}).out).is_object()) << scene;
    }
    EXPECT_TRUE(folder.contents().empty());
}

TEST(Devices, OneIsChosen) {
    const ScratchFolder folder;
    const json list = json::parse(runWell(folder, {"devices", "--json"}).out);
    EXPECT_EQ(std::count_if(list.begin(), list.end(),
                            [](const json& device) { return device.at("chosen").get<bool>(); }),
              1);
    for (const json& device : list)
        EXPECT_TRUE(!device.at("chosen").get<bool>() || device.at("refusals").empty());
    EXPECT_NE(runWell(folder, {"devices"}).out.find("chosen"), std::string::npos);
}

TEST(Help, EverySubcommandHasIt) {
    const ScratchFolder folder;
    for (const Words& arguments : {Words{"--help"}, Words{"render", "--help"}, Words{"info", "--help"},
                                   Words{"devices", "--help"}, Words{"view", "--help"}, Words{"--version"}}) {
        const Outcome outcome = runWell(folder, arguments);
        EXPECT_NE(outcome.out, "");
        EXPECT_EQ(outcome.err, "");
    }
    EXPECT_NE(runWell(folder, {"render", "--help"}).out.find("--first-sample"), std::string::npos);
}

}  // namespace
}  // namespace licht::test
