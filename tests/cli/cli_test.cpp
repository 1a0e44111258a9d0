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

TEST(Render, SkiesAreTurnedAndMadeStronger) {
    const ScratchFolder folder;
    // The middle of the map, at -Z, is red, its rest green.
    ExrPicture map;
    map.width = 8;
    map.height = 4;
    std::vector<float> red(32, 0.0F);
    std::vector<float> green(32, 1.0F);
    for (std::size_t row = 0; row < 4; ++row)
        for (std::size_t column = 2; column < 6; ++column)
            std::swap(red[row * 8 + column], green[row * 8 + column]);
    map.channels = {{"R", red}, {"G", green}, {"B", std::vector<float>(32, 0.0F)}};
    writeExr(folder.path() / "sky.exr", map);
    const auto middle = [&](const Words& more) {
        Words words{"render", "empty",         "--size",  "9",  "--spp",
                    "1",      "--environment", "sky.exr", "-o", "a.exr"};
        words.insert(words.end(), more.begin(), more.end());
        runWell(folder, words);
        const ExrPicture picture = readExr(folder.path() / "a.exr");
        EXPECT_EQ(picture.width, 9);
        EXPECT_EQ(picture.height, 5);
        EXPECT_EQ(attribute(picture, "licht.environment"), "sky.exr");
        const std::size_t at = 2 * 9 + 4;
        return std::pair{picture.find("R")->values[at], picture.find("G")->values[at]};
    };
    EXPECT_EQ(middle({}), std::pair(1.0F, 0.0F)) << "cameras look along -Z";
    EXPECT_EQ(middle({"--environment-rotation", "180"}), std::pair(0.0F, 1.0F));
    EXPECT_EQ(middle({"--environment-rotation=-540", "--environment-strength", "4"}), std::pair(0.0F, 4.0F));
    EXPECT_EQ(middle({"--environment-rotation", "360"}), std::pair(1.0F, 0.0F));
}

TEST(Render, TakesTheValueOfQueuesAsAWordToo) {
    const ScratchFolder folder;
    for (const Words& said : {Words{"--queues", "off", "cornell"}, Words{"cornell", "--queues=off"}}) {
        Words words{"render", "--size", "8", "--spp", "1", "--report", "report.json"};
        words.insert(words.end(), said.begin(), said.end());
        runWell(folder, words);
        EXPECT_EQ(json::parse(folder.read("report.json"))["settings"]["queues"], "off");
    }
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
    Words names{"A", "B", "G", "N.X", "N.Y", "N.Z", "R", "Z", "albedo.B", "albedo.G", "albedo.R"};
    for (int order = 0; order <= 8; ++order)
        for (const char* channel : {"B", "G", "R"})
            names.push_back("bounces." + std::to_string(order) + "." + channel);
    names.insert(names.end(), {"motion.X", "motion.Y", "sampleCount", "unfiltered.B", "unfiltered.G",
                               "unfiltered.R", "variance.B", "variance.G", "variance.R"});
    EXPECT_EQ(channelNames(picture), names);
    for (const float count : picture.find("sampleCount")->values) EXPECT_EQ(count, 3.0F);
    for (const char* channel : {"variance.R", "albedo.G"})
        for (const float value : picture.find(channel)->values) EXPECT_GE(value, 0.0F) << channel;
    EXPECT_EQ(attribute(picture, "licht.scene"), "cornell");
    EXPECT_EQ(attribute(picture, "licht.spp"), "3");
    EXPECT_EQ(attribute(picture, "licht.bounces"), "8");
    EXPECT_NE(attribute(picture, "licht.device"), "(none)");
}

TEST(Render, OrdersAreReportedWithShareTimeAndTail) {
    for (const bool queues : {false, true}) {
        const ScratchFolder folder;
        Words words{"render",    "furnace",     "--size",     "32x24", "--spp", "4",
                    "--bounces", "5",           "-o",         "a.png", "--aov", "bounces",
                    "--report",  "report.json", "--roulette", "8"};  // a path ended by chance is noise
        if (queues) words.push_back("--queues");
        runWell(folder, words);
        const json report = json::parse(folder.read("report.json"));
        const json& orders = report.at("orders");
        ASSERT_EQ(orders.size(), 6U);
        double shares = 0.0;
        for (std::size_t i = 0; i < 6; ++i) {
            EXPECT_EQ(orders[i].at("order"), i);
            // Le r^i of albedo and emission one half; every factor is a power of two.
            EXPECT_NEAR(orders[i].at("mean")[1].get<double>(), std::pow(0.5, static_cast<double>(i) + 1.0),
                        1e-7);
            EXPECT_EQ(orders[i].at("rays"), 32 * 24 * 4);
            EXPECT_GT(orders[i].at("seconds").get<double>(), 0.0) << i;
            EXPECT_NEAR(orders[i].at("standard_error").get<double>(), 0.0, 1e-9);
            EXPECT_EQ(orders[i].at("seconds_by"), queues ? "passes" : "rays");
            shares += orders[i].at("share").get<double>();
        }
        EXPECT_NEAR(shares, 1.0, 1e-9);
        // Behind five bounces 2^-6 of all light is still to come.
        EXPECT_NEAR(report.at("tail").at("share").get<double>(), 1.0 / 64.0, 1e-6);
        EXPECT_NEAR(report.at("tail").at("ratio").get<double>(), 0.5, 1e-6);
    }
}

TEST(Render, BouncesAreChosenByTheErrorAskedFor) {
    const ScratchFolder folder;
    runWell(folder, {"render", "furnace", "--size", "16x12", "--spp", "1", "--bounces", "auto", "-o", "a.exr",
                     "--report", "report.json", "--roulette", "8"});
    const json report = json::parse(folder.read("report.json"));
    EXPECT_EQ(report.at("bounces"), 6);
    EXPECT_EQ(report.at("bounces_auto").at("reached"), true);
    EXPECT_NEAR(report.at("bounces_auto").at("tail").at("share").get<double>(), 1.0 / 128.0, 1e-6);
    EXPECT_GT(report.at("bounces_auto").at("pilot_seconds").get<double>(), 0.0);
    const ExrPicture picture = readExr(folder.path() / "a.exr");
    EXPECT_EQ(attribute(picture, "licht.bounces"), "6");
    for (const float value : picture.find("R")->values) EXPECT_NEAR(value, 1.0F - 1.0F / 128.0F, 1e-5F);
}

TEST(Render, SamplingSettingsAreNamed) {
    const ScratchFolder folder;
    runWell(folder, {"render",
                     "cornell",
                     "--size",
                     "16x16",
                     "--spp",
                     "5",
                     "--direct",
                     "area",
                     "--mis",
                     "balance",
                     "--lights",
                     "power",
                     "--environment-sampling",
                     "rejection",
                     "--sampler",
                     "blue",
                     "-o",
                     "a.exr",
                     "--report",
                     "report.json"});
    const json report = json::parse(folder.read("report.json"));
    EXPECT_EQ(report.at("sampling"), json({{"direct", "area"},
                                           {"mis", "balance"},
                                           {"lights", "power"},
                                           {"environment_sampling", "rejection"},
                                           {"sampler", "blue"},
                                           {"blue_samples", 8}}));
    for (const char* none : {"adaptive", "declared_bias", "orders", "tail", "bounces_auto", "sequence"})
        EXPECT_TRUE(report.at(none).is_null()) << none;
    const ExrPicture picture = readExr(folder.path() / "a.exr");
    EXPECT_EQ(attribute(picture, "licht.direct"), "area");
    EXPECT_EQ(attribute(picture, "licht.mis"), "balance");
    EXPECT_EQ(attribute(picture, "licht.lights"), "power");
    EXPECT_EQ(attribute(picture, "licht.environmentSampling"), "rejection");
    EXPECT_EQ(attribute(picture, "licht.sampler"), "blue");
    EXPECT_EQ(attribute(picture, "licht.declaredBias"), "none");
}

TEST(Render, ShortcutsAreDeclared) {
    const ScratchFolder folder;
    const Outcome outcome =
        runWell(folder, {"render", "cornell", "--size", "24x24", "--spp", "4", "--clamp", "0.05",
                         "--regularise", "-o", "a.exr", "--report", "report.json"});
    const std::string said = "biased: clamp 0.05 cd/m^2 took";
    const std::vector<std::string> lines = outcome.errorLines();
    EXPECT_EQ(std::count_if(lines.begin(), lines.end(),
                            [&](const std::string& line) { return line.find(said) != std::string::npos; }),
              1)
        << outcome.err;
    const json bias = json::parse(folder.read("report.json")).at("declared_bias");
    const json& clamp = bias.at("clamp");
    for (std::size_t c = 0; c < 3; ++c) EXPECT_GT(clamp.at("lost")[c].get<double>(), 0.0);
    EXPECT_GT(clamp.at("share").get<double>(), 0.0);
    EXPECT_LT(clamp.at("share").get<double>(), 1.0);
    EXPECT_EQ(bias.at("regularise").at("change"), 0.0) << "nothing is glossy in the box";
    EXPECT_NE(attribute(readExr(folder.path() / "a.exr"), "licht.declaredBias"), "none");
}

TEST(Render, ThePictureBeforeTheFilterIsThereToo) {
    const ScratchFolder folder;
    runWell(folder, {"render", "cornell", "--size", "32x32", "--spp", "4", "--denoise", "spatiotemporal",
                     "--unfiltered", "raw.png", "-o", "a.png", "-o", "a.exr", "--aov", "unfiltered",
                     "--report", "report.json"});
    const json report = json::parse(folder.read("report.json"));
    EXPECT_LT(report.at("relative_error").get<double>(),
              report.at("unfiltered_relative_error").get<double>());
    EXPECT_NE(folder.read("raw.png"), folder.read("a.png"));
    // By the same samples: what the layer has is what the picture shows.
    const ExrPicture layers = readExr(folder.path() / "a.exr");
    const EncodedImage raw = decodeImage(readFile(folder.path() / "raw.png"), "raw.png");
    const std::vector<float>& red = layers.find("unfiltered.R")->values;
    const auto brightest = static_cast<std::size_t>(std::max_element(red.begin(), red.end()) - red.begin());
    const auto darkest = static_cast<std::size_t>(std::min_element(red.begin(), red.end()) - red.begin());
    EXPECT_GT(raw.bytes[4 * brightest], raw.bytes[4 * darkest]);
}

TEST(Render, AdaptiveSamplesDifferFromPixelToPixel) {
    const ScratchFolder folder;
    runWell(folder, {"render", "cornell", "--size", "32x32", "--spp", "24", "--adaptive", "-o", "a.exr", "-o",
                     "a.png", "--aov", "sampleCount,variance", "--report", "report.json"});
    const json report = json::parse(folder.read("report.json"));
    EXPECT_EQ(report.at("spp"), 24);
    EXPECT_EQ(report.at("stopped_by"), "spp");
    EXPECT_GT(report.at("relative_error").get<double>(), 0.0);
    const ExrPicture picture = readExr(folder.path() / "a.exr");
    const std::vector<float>& counts = picture.find("sampleCount")->values;
    const auto [fewest, most] = std::minmax_element(counts.begin(), counts.end());
    EXPECT_LT(*fewest, *most);
    EXPECT_EQ(report.at("adaptive").at("fewest_samples"), *fewest);
    EXPECT_EQ(report.at("adaptive").at("most_samples"), *most);
    double sum = 0.0;
    for (const float count : counts) sum += static_cast<double>(count);
    // Each round leaves at most half a sample of its last tile over, a sixteenth of the picture.
    EXPECT_NEAR(sum / 1024.0, 24.0, 2 * 0.5 / 16.0);
}

TEST(Render, AdaptiveStopsByTimeAndByError) {
    const ScratchFolder folder;
    const auto report = [&folder](const Words& rule) {
        Words words{"render", "cornell", "--size", "16x16", "--adaptive", "--report", "report.json"};
        words.insert(words.end(), rule.begin(), rule.end());
        runWell(folder, words);
        return json::parse(folder.read("report.json"));
    };
    const json by_time = report({"--time", "0.5"});
    EXPECT_EQ(by_time.at("stopped_by"), "time");
    EXPECT_GE(by_time.at("spp").get<int>(), 2);
    const json by_error = report({"--error", "0.2"});
    EXPECT_EQ(by_error.at("stopped_by"), "error");
    EXPECT_LE(by_error.at("relative_error").get<double>(), 0.2);
    EXPECT_EQ(report({"--spp", "1"}).at("spp"), 1);
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

TEST(Interrupt, AdaptiveKeepsItsWholeRounds) {
    const ScratchFolder folder;
    RunningProgram program(folder, {"render", "cornell", "--size", "64x64", "--adaptive", "--spp",
                                    "4294967295", "-o", "a.exr", "--report", "report.json"});
    ASSERT_TRUE(program.waitUntilCatches(SIGINT));
    program.send(SIGINT);
    const Outcome outcome = program.wait();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const json report = json::parse(folder.read("report.json"));
    EXPECT_EQ(report.at("stopped_by"), "interrupt");
    EXPECT_GE(report.at("spp").get<int>(), 1);
    EXPECT_TRUE(allFinite(readExr(folder.path() / "a.exr"), "R"));
}

INSTANTIATE_TEST_SUITE_P(Cli, InterruptTest, testing::Values(SIGINT, SIGTERM, SIGHUP),
                         [](const testing::TestParamInfo<int>& sent) {
                             return sent.param == SIGINT ? "Int" : sent.param == SIGTERM ? "Term" : "Hup";
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
    for (const Words& arguments :
         {Words{"--help"}, Words{"render", "--help"}, Words{"info", "--help"}, Words{"devices", "--help"},
          Words{"view", "--help"}, Words{"accuracy", "--help"}, Words{"--version"}, Words{"help"},
          Words{"help", "render"}, Words{"version"}}) {
        const Outcome outcome = runWell(folder, arguments);
        EXPECT_NE(outcome.out, "");
        EXPECT_EQ(outcome.err, "");
    }
    EXPECT_NE(runWell(folder, {"render", "--help"}).out.find("--first-sample"), std::string::npos);
    EXPECT_EQ(runWell(folder, {"help", "render"}).out, runWell(folder, {"render", "--help"}).out);
    EXPECT_EQ(runWell(folder, {"version"}).out, runWell(folder, {"--version"}).out);
    const Outcome scene = runLicht(folder, {"cornell"});
    EXPECT_EQ(scene.exit_code, 2);
    EXPECT_NE(scene.err.find("licht render cornell"), std::string::npos) << scene.err;
}

}  // namespace
}  // namespace licht::test
