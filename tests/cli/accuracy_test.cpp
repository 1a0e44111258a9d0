// licht accuracy: its numbers, its files, and what an interruption leaves.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <thread>

#include "licht/image/exr.h"
#include "run_program.h"

namespace licht::test {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;

Outcome runWell(const ScratchFolder& folder, const Words& arguments) {
    Outcome outcome = runLicht(folder, arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err.find("validation:"), std::string::npos) << outcome.err;
    return outcome;
}

bool has(const std::string& text, const std::string& word) {
    return text.find(word) != std::string::npos;
}

/// Whether every element of XML is closed by its own name; without comments and the like.
bool isWellFormed(const std::string& xml) {
    const std::regex tag(R"rule(<(/?)(\w+)((?:\s+[\w-]+="[^"<&]*")*)\s*(/?)>)rule");
    std::vector<std::string> open;
    std::size_t end = 0;
    for (auto at = std::sregex_iterator(xml.begin(), xml.end(), tag); at != std::sregex_iterator(); ++at) {
        const auto begin = static_cast<std::size_t>(at->position());
        if (xml.substr(end, begin - end).find_first_of("<>") != std::string::npos) return false;
        if (open.empty() && end > 0) return false;
        end = begin + static_cast<std::size_t>(at->length());
        if ((*at)[1] == "/") {
            if (open.empty() || open.back() != (*at)[2]) return false;
            open.pop_back();
        } else if ((*at)[4] != "/") {
            open.push_back((*at)[2]);
        }
    }
    return open.empty() && xml.substr(end) == "\n";
}

std::vector<Words> rowsOf(const std::string& csv) {
    std::vector<Words> rows;
    std::istringstream lines(csv);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream fields(line);
        Words& row = rows.emplace_back();
        for (std::string field; std::getline(fields, field, ',');) row.push_back(field);
    }
    return rows;
}

const Words kOwnModes{"none", "temporal", "spatiotemporal"};
const Words kModes = LICHT_HAS_OIDN == 1 ? Words{"none", "temporal", "spatiotemporal", "oidn"} : kOwnModes;

TEST(Accuracy, WritesWholeFiles) {
    const ScratchFolder folder;
    const Outcome outcome = runWell(
        folder, {"accuracy", "cornell", "--temporal", "--size", "16x16", "--frames", "3", "--fps", "6",
                 "--reference-spp", "16", "--json", "a.json", "--csv", "a.csv", "--svg", "a.svg"});
    EXPECT_EQ(folder.contents(), (Words{"a.csv", "a.json", "a.svg"}));
    const json report = json::parse(folder.read("a.json"));
    EXPECT_EQ(report.at("scene"), "cornell");
    EXPECT_EQ(report.at("width"), 16);
    EXPECT_EQ(report.at("path"), "strafe");
    EXPECT_EQ(report.at("fps"), 6.0);
    EXPECT_EQ(report.at("spp"), 1);
    EXPECT_EQ(report.at("reference_spp"), 16);
    EXPECT_GT(report.at("reference_relmse").get<double>(), 0.0);
    EXPECT_EQ(report.at("frames"), 3);
    EXPECT_EQ(report.at("measured_frames"), 3);
    ASSERT_EQ(report.at("modes").size(), kModes.size());
    const std::vector<Words> rows = rowsOf(folder.read("a.csv"));
    ASSERT_EQ(rows.size(), 1 + 3 * kModes.size());
    EXPECT_EQ(rows[0], (Words{"mode", "frame", "relmse", "flip", "ms"}));
    for (std::size_t m = 0; m < kModes.size(); ++m) {
        const json& mode = report.at("modes")[m];
        EXPECT_EQ(mode.at("mode"), kModes[m]);
        ASSERT_EQ(mode.at("frames").size(), 3U);
        double relmse = 0.0;
        double flip = 0.0;
        double ms = 0.0;
        for (std::size_t i = 0; i < 3; ++i) {
            const json& frame = mode.at("frames")[i];
            EXPECT_EQ(frame.at("frame"), i);
            EXPECT_GT(frame.at("flip").get<double>(), 0.0);
            EXPECT_LT(frame.at("flip").get<double>(), 1.0);
            EXPECT_GT(frame.at("ms").get<double>(), 0.0);
            relmse += frame.at("relmse").get<double>() / 3.0;
            flip += frame.at("flip").get<double>() / 3.0;
            ms += frame.at("ms").get<double>() / 3.0;
            const Words& row = rows[1 + 3 * m + i];
            ASSERT_EQ(row.size(), 5U);
            EXPECT_EQ(row[0] + row[1], kModes[m] + std::to_string(i));
            // Six digits, and milliseconds to a thousandth.
            for (const auto& [column, key] : {std::pair(2U, "relmse"), std::pair(3U, "flip")}) {
                const double value = frame.at(key).get<double>();
                EXPECT_NEAR(std::stod(row[column]), value, 1e-5 * std::abs(value)) << key;
            }
            EXPECT_NEAR(std::stod(row[4]), frame.at("ms").get<double>(), 1e-3);
        }
        EXPECT_NEAR(mode.at("relmse").get<double>(), relmse, 1e-12);
        EXPECT_NEAR(mode.at("flip").get<double>(), flip, 1e-12);
        EXPECT_NEAR(mode.at("ms_per_frame").get<double>(), ms, 1e-9);
        EXPECT_GT(mode.at("flicker").get<double>(), 0.0);
        EXPECT_TRUE(has(outcome.out, "\n" + kModes[m] + " ")) << outcome.out;
    }
    EXPECT_EQ(report.at("modes")[0].at("ghost").at("value"), 0.0) << "raw frames beside themselves";
    for (const char* word : {"ms/frame", "relMSE", "of raw", "FLIP", "flicker", "ghost", " 1/1 "})
        EXPECT_TRUE(has(outcome.out, word)) << word << "\n" << outcome.out;
    const std::string svg = folder.read("a.svg");
    EXPECT_TRUE(isWellFormed(svg)) << svg;
    EXPECT_TRUE(has(svg, "cornell, path strafe"));
    for (const std::string& mode : kModes) EXPECT_TRUE(has(svg, ">" + mode + "<")) << mode;
}

// Every pixel of the furnace is known, and free of noise but for the few rays that leave along its edges; no
// path of two bounces is ended by chance.
TEST(Accuracy, OfWhatHasNoNoiseIsNothing) {
    const ScratchFolder folder;
    runWell(folder,
            {"accuracy", "furnace", "--temporal", "--size", "16x16", "--frames", "3", "--path", "orbit",
             "--fps", "6", "--bounces", "2", "--reference-spp", "2", "--json", "a.json", "--quiet"});
    const json report = json::parse(folder.read("a.json"));
    for (std::size_t m = 0; m < kOwnModes.size(); ++m) {
        const json& mode = report.at("modes")[m];
        // Pixels are right to 1e-4 of one: so are their squares, and the four of a change. CIELAB's lightness
        // of 0.875 is then off by d = 116 / 3 * 0.875^(-2/3) * 1e-4, which FLIP makes 0.95 d^0.7 / 16.51.
        EXPECT_NEAR(mode.at("relmse").get<double>(), 0.0, 1e-8) << mode.at("mode");
        EXPECT_NEAR(mode.at("flicker").get<double>(), 0.0, 4e-4) << mode.at("mode");
        const double lightness = 116.0 / 3.0 * std::pow(0.875, -2.0 / 3.0) * 1e-4;
        EXPECT_NEAR(mode.at("flip").get<double>(), 0.0, 0.95 * std::pow(lightness, 0.7) / 16.51)
            << mode.at("mode");
    }
}

// The frame and its truth as render draws them and compare measures them: the truth is the mean of two
// pictures of half the samples, by seeds that follow from the frame's.
TEST(Accuracy, IsThatOfRenderAndCompare) {
    const ScratchFolder folder;
    const Words picture{"cornell", "--size", "24x16", "--bounces", "3"};
    const auto with = [&picture](Words words, const Words& more) {
        words.insert(words.end(), picture.begin(), picture.end());
        words.insert(words.end(), more.begin(), more.end());
        return words;
    };
    constexpr std::uint32_t kSeed = 7;
    constexpr std::uint32_t kFirst = kSeed * 2654435761U + 1U;
    constexpr std::uint32_t kSecond = kFirst * 2654435761U + 1U;
    runWell(folder, with({"accuracy"}, {"--temporal", "--path", "rest", "--frames", "3", "--seed", "7",
                                        "--spp", "3", "--reference-spp", "32", "--json", "a.json"}));
    runWell(folder, with({"render"}, {"--seed", "7", "--spp", "3", "-o", "frame.exr"}));
    runWell(folder,
            with({"render"}, {"--seed", "7", "--spp", "3", "--first-sample", "6", "-o", "third.exr"}));
    for (const auto& [seed, name] : {std::pair(kFirst, "one.exr"), std::pair(kSecond, "two.exr")})
        runWell(folder, with({"render"}, {"--seed", std::to_string(seed), "--spp", "16", "-o", name}));
    ExrPicture truth = readExr(folder.path() / "one.exr");
    const ExrPicture other = readExr(folder.path() / "two.exr");
    for (ExrChannel& channel : truth.channels)
        for (std::size_t i = 0; i < channel.values.size(); ++i)
            channel.values[i] = 0.5F * (channel.values[i] + other.find(channel.name)->values[i]);
    writeExr(folder.path() / "truth.exr", truth);
    runWell(folder, {"compare", "truth.exr", "frame.exr", "one.exr", "third.exr", "--json", "c.json"});
    const json compared = json::parse(folder.read("c.json")).at("pictures");
    const json measured = json::parse(folder.read("a.json"));
    const json& frame = measured.at("modes")[0].at("frames")[0];
    // The same pixels: what doubles round.
    const double of_truth = compared[1].at("rel_mse").get<double>();
    EXPECT_NEAR(measured.at("reference_relmse").get<double>(), of_truth, 1e-12);
    EXPECT_NEAR(frame.at("relmse").get<double>(), compared[0].at("rel_mse").get<double>() - of_truth, 1e-12);
    EXPECT_NEAR(frame.at("flip").get<double>(), compared[0].at("flip").get<double>(), 1e-12);
    EXPECT_GT(frame.at("flip").get<double>(), 0.01);
    // The camera rests, but a frame of mode none is its own samples, got back from their mean with all before
    // it: of nine, each rounded to 6e-8.
    const double third = compared[2].at("rel_mse").get<double>() - of_truth;
    EXPECT_NEAR(measured.at("modes")[0].at("frames")[2].at("relmse").get<double>(), third, 1e-5 * third);
}

// A cut is a fresh start, bit for bit; whatever else changed is told by curves of its own.
TEST(Accuracy, SaysHowSoonItRecovers) {
    const ScratchFolder folder;
    const Outcome outcome =
        runWell(folder, {"accuracy", "cornell", "--temporal", "--size", "16x16", "--path", "cut", "--frames",
                         "6", "--reference-spp", "16", "--json", "a.json"});
    const json modes = json::parse(folder.read("a.json")).at("modes");
    for (std::size_t m = 1; m < kOwnModes.size(); ++m) {
        EXPECT_EQ(modes[m].at("recover_frames").at("cut"), 0);
        EXPECT_TRUE(modes[m].at("recover_frames").at("light").is_null());
        EXPECT_TRUE(modes[m].at("recovery").at("light").empty());
        const json& steps = modes[m].at("recovery").at("cut");
        ASSERT_EQ(steps.size(), 3U) << "frames from the cut on";
        for (std::size_t i = 0; i < steps.size(); ++i) {
            EXPECT_EQ(steps[i].at("pixels"), 256);
            EXPECT_EQ(steps[i].at("relmse"), steps[i].at("fresh_relmse"));
            EXPECT_NEAR(steps[i].at("relmse").get<double>(),
                        modes[m].at("frames")[3 + i].at("relmse").get<double>(), 1e-12);
        }
    }
    for (std::size_t m = 0; m < modes.size(); m += kOwnModes.size())
        for (const json& frames : modes[m].at("recover_frames"))
            EXPECT_TRUE(frames.is_null()) << "no history";
    EXPECT_TRUE(has(outcome.out, " recovers\n")) << outcome.out;
    EXPECT_TRUE(has(outcome.out, " 0 - -\n")) << outcome.out;
}

// The lamp is switched off after a second.
TEST(Accuracy, LightThatIsSwitchedIsAChange) {
    const ScratchFolder folder;
    runWell(folder, {"accuracy", "moving", "--temporal", "--size", "32x18", "--path", "rest", "--frames", "6",
                     "--fps", "3", "--reference-spp", "32", "--bounces", "3", "--json", "a.json"});
    for (const json& mode : json::parse(folder.read("a.json")).at("modes")) {
        const json& light = mode.at("recovery").at("light");
        if (mode.at("mode") == "none") continue;
        ASSERT_GE(light.size(), 3U);
        EXPECT_EQ(light[0].at("pixels"), 32 * 18);
        for (const json& step : light) EXPECT_GT(step.at("fresh_relmse").get<double>(), 0.0);
        std::uint64_t uncovered = 0;
        for (const json& step : mode.at("recovery").at("disocclusion"))
            uncovered += step.at("pixels").get<std::uint64_t>();
        EXPECT_GT(uncovered, 0U) << "the box moves";
        EXPECT_LT(uncovered, 6U * 32U * 18U);
    }
}

TEST(Accuracy, AnInterruptionKeepsWhatIsMeasured) {
    const ScratchFolder folder;
    RunningProgram program(folder,
                           {"accuracy", "cornell", "--temporal", "--size", "16x16", "--frames", "100000",
                            "--reference-spp", "2", "--json", "a.json", "--csv", "a.csv", "--svg", "a.svg"});
    ASSERT_TRUE(program.waitUntilCatches(SIGINT));
    std::this_thread::sleep_for(std::chrono::seconds(4));
    program.send(SIGINT);
    const Outcome outcome = program.wait();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const json report = json::parse(folder.read("a.json"));
    const auto frames = report.at("measured_frames").get<std::size_t>();
    EXPECT_TRUE(
        has(outcome.err, "licht: interrupted: measured " + std::to_string(frames) + " of 100000 frames\n"))
        << outcome.err;
    EXPECT_EQ(report.at("frames"), 100000);
    for (const json& mode : report.at("modes")) EXPECT_EQ(mode.at("frames").size(), frames);
    EXPECT_EQ(rowsOf(folder.read("a.csv")).size(), 1 + kModes.size() * frames);
    EXPECT_TRUE(isWellFormed(folder.read("a.svg")));
    EXPECT_EQ(folder.contents(), (Words{"a.csv", "a.json", "a.svg"}));
}

// A truth of so many samples has no end.
TEST(Accuracy, AnInterruptionBeforeTheFirstFrameSaysSo) {
    const ScratchFolder folder;
    RunningProgram program(
        folder, {"accuracy", "cornell", "--temporal", "--size", "16x16", "--frames", "3", "--reference-spp",
                 "4294967295", "--json", "a.json", "--csv", "a.csv", "--svg", "a.svg"});
    ASSERT_TRUE(program.waitUntilCatches(SIGINT));
    program.send(SIGINT);
    const Outcome outcome = program.wait();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "no frame was measured\n");
    EXPECT_TRUE(has(outcome.err, "interrupted: measured 0 of 3 frames")) << outcome.err;
    const json report = json::parse(folder.read("a.json"));
    EXPECT_EQ(report.at("measured_frames"), 0);
    EXPECT_EQ(report.at("reference_relmse"), 0.0);
    for (const json& mode : report.at("modes")) {
        EXPECT_EQ(mode.at("relmse"), 0.0);
        EXPECT_EQ(mode.at("flip"), 0.0);
        EXPECT_TRUE(mode.at("frames").empty());
    }
    EXPECT_EQ(folder.read("a.csv"), "mode,frame,relmse,flip,ms\n");
    EXPECT_TRUE(isWellFormed(folder.read("a.svg")));
}

TEST(Accuracy, HelpSaysWhatItMeasures) {
    const ScratchFolder folder;
    const std::string help = runWell(folder, {"accuracy", "--help"}).out;
    for (const char* word :
         {"relMSE",        "FLIP",   "flicker", "ghost",     "recovers", "of raw",
          "--temporal",    "--path", "orbit",   "strafe",    "cut",      "still-move-still",
          "--frames",      "--fps",  "--spp",   "--bounces", "--seed",   "--reference-spp",
          "--json",        "--csv",  "--svg",   "--size",    "--device", "--camera",
          "--environment", "--quiet"})
        EXPECT_TRUE(has(help, word)) << word << "\n" << help;
}

}  // namespace
}  // namespace licht::test
