// licht render --path: a camera's path, a picture each frame.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <nlohmann/json.hpp>
#include <numbers>
#include <thread>

#include "licht/core/file.h"
#include "licht/image/exr.h"
#include "licht/image/files.h"
#include "run_program.h"

namespace licht::test {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;

Words operator+(Words a, const Words& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

/// Runs and demands success without a word from the validation layer.
Outcome runWell(const ScratchFolder& folder, const Words& arguments) {
    Outcome outcome = runLicht(folder, arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err.find("validation:"), std::string::npos) << outcome.err;
    return outcome;
}

ExrPicture pictureOf(const ScratchFolder& folder, const std::string& name) {
    return readExr(folder.path() / name);
}

bool sameBits(const ExrPicture& a, const ExrPicture& b) {
    return std::equal(a.channels.begin(), a.channels.end(), b.channels.begin(), b.channels.end(),
                      [](const ExrChannel& x, const ExrChannel& y) {
                          return x.name == y.name && x.values.size() == y.values.size() &&
                                 std::memcmp(x.values.data(), y.values.data(),
                                             x.values.size() * sizeof(float)) == 0;
                      });
}

std::string frameName(std::size_t frame, const char* ending = ".exr") {
    std::string name = "f";
    name += std::to_string(frame);
    name += ending;
    return name;
}

std::string samplesOf(const ExrPicture& picture) {
    for (const auto& [key, value] : picture.attributes)
        if (key == "licht.spp") return value;
    return "(none)";
}

/// A triangle under a neutral sky, and two cameras that look at it.
constexpr const char* kTwoCameras = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1,2]}],
"nodes":[{"mesh":0},{"camera":0,"translation":[0.3,0.3,2]},
{"camera":1,"translation":[1.5,0.3,1.5],"rotation":[0,0.38268343,0,0.92387953]}],
"cameras":[{"name":"before","type":"perspective","perspective":{"yfov":0.6,"znear":0.01}},
{"name":"aside","type":"perspective","perspective":{"yfov":0.8,"znear":0.01}}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,
"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";

TEST(Sequence, WritesEveryFrameAndReportsThem) {
    const ScratchFolder folder;
    const Outcome outcome =
        runWell(folder, {"render", "cornell", "--size", "16x16", "--path", "cut", "--frames", "4", "--fps",
                         "12.5", "-o", "f-%02d.exr", "-o", "g%d.png", "--report", "report.json"});
    EXPECT_EQ(folder.contents(), (Words{"f-00.exr", "f-01.exr", "f-02.exr", "f-03.exr", "g0.png", "g1.png",
                                        "g2.png", "g3.png", "report.json"}));
    EXPECT_NE(outcome.out.find("4 of 4 frames"), std::string::npos) << outcome.out;
    EXPECT_EQ(decodeImage(readFile(folder.path() / "g3.png"), "g3.png").width, 16);
    EXPECT_FALSE(sameBits(pictureOf(folder, "f-01.exr"), pictureOf(folder, "f-02.exr")));
    const json report = json::parse(folder.read("report.json"));
    EXPECT_EQ(report.at("outputs"),
              json({"f-00.exr", "g0.png", "f-01.exr", "g1.png", "f-02.exr", "g2.png", "f-03.exr", "g3.png"}));
    EXPECT_EQ(report.at("stopped_by"), "spp");
    const json& sequence = report.at("sequence");
    EXPECT_EQ(sequence.at("path"), "cut");
    EXPECT_EQ(sequence.at("fps"), 12.5);
    ASSERT_EQ(sequence.at("frames").size(), 4U);
    double seconds = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
        const json& frame = sequence.at("frames")[i];
        EXPECT_EQ(frame.at("frame"), i);
        EXPECT_EQ(frame.at("cut"), i == 2);
        EXPECT_TRUE(frame.at("relative_error").is_null() || frame.at("relative_error") > 0.0);
        seconds += frame.at("seconds").get<double>();
    }
    EXPECT_GT(seconds, 0.0);
    EXPECT_LE(seconds, report.at("seconds").at("render").get<double>());
}

TEST(Sequence, OneThatIsNotAskedForIsNull) {
    const ScratchFolder folder;
    runWell(folder, {"render", "cornell", "--size", "8x8", "--spp", "1", "--report", "report.json"});
    EXPECT_TRUE(json::parse(folder.read("report.json")).at("sequence").is_null());
}

TEST(Sequence, NamesItsFramesAfterTheScene) {
    const ScratchFolder folder;
    const Words render{"render", "cornell", "--size", "8x8", "--path", "orbit", "--frames", "2"};
    EXPECT_NE(runWell(folder, render).out, "");
    EXPECT_EQ(folder.contents(), (Words{"cornell-0000.png", "cornell-0001.png"}));
    folder.write("cornell-0001.png", "somebody's");
    EXPECT_EQ(runLicht(folder, render).exit_code, 2);
    EXPECT_EQ(folder.read("cornell-0001.png"), "somebody's");
    const Outcome quiet = runWell(folder, render + Words{"-o", "f%d.png", "--quiet"});
    EXPECT_EQ(quiet.out + quiet.err, "");
}

TEST(Sequence, BuiltinPathsBeginWithTheStill) {
    const ScratchFolder folder;
    const Words render{"render", "cornell", "--size", "16x16", "--spp", "2", "--first-sample", "5"};
    runWell(folder, render + Words{"-o", "still.exr"});
    const ExrPicture still = pictureOf(folder, "still.exr");
    for (const char* path : {"orbit", "strafe", "cut", "still-move-still"}) {
        runWell(folder, render + Words{"--path", path, "--frames", "1", "-o", std::string(path) + "%d.exr"});
        EXPECT_TRUE(sameBits(pictureOf(folder, std::string(path) + "0.exr"), still)) << path;
    }
}

// A frame is the still of its camera and of the samples behind those of the frames before it.
TEST(Sequence, FramesAreStillsWhoseSamplesGoOnCounting) {
    const ScratchFolder folder;
    folder.write("scene.gltf", kTwoCameras);
    // Times of keys that are times of frames; frame 2 cuts back, frames 3 and 4 move and rest.
    folder.write("path.json", R"({"keys": [
        {"time": 0, "camera": "before"},
        {"time": 1, "camera": 1},
        {"time": 2, "camera": "before", "cut": true},
        {"time": 3, "eye": [0.3, 0.3, 3], "target": [0.3, 0.3, 0], "yfov": 40}]})");
    const Words render{"render", "scene.gltf", "--size", "32x24", "--spp", "2", "--aov", "albedo"};
    runWell(folder, render + Words{"--path", "path.json", "--fps", "1", "--frames", "5", "-o", "f%d.exr",
                                   "--report", "report.json"});
    struct Still {
        const char* frame;
        const char* camera;
        const char* first_sample;
    };
    for (const auto& [frame, camera, first_sample] :
         {Still{"f0.exr", "before", "0"}, Still{"f1.exr", "aside", "2"}, Still{"f2.exr", "before", "0"}}) {
        runWell(folder, render + Words{"--camera", camera, "--first-sample", first_sample, "-o", "s.exr"});
        EXPECT_TRUE(sameBits(pictureOf(folder, frame), pictureOf(folder, "s.exr"))) << frame;
    }
    EXPECT_EQ(samplesOf(pictureOf(folder, "f3.exr")), "2");
    EXPECT_EQ(samplesOf(pictureOf(folder, "f4.exr")), "4") << "a camera that rests goes on";
    const json frames = json::parse(folder.read("report.json")).at("sequence").at("frames");
    for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(frames[i].at("cut"), i == 2) << i;
    const std::vector<float>& albedo = pictureOf(folder, "f3.exr").find("albedo.R")->values;
    const auto hits = std::count_if(albedo.begin(), albedo.end(), [](float value) { return value > 0.0F; });
    // At 40 degrees and 3 m the picture is 2.18 m high and holds the triangle's half square metre, give or
    // take the pixels that its edges cross, which go 2 m across and 2 m up.
    const double pixel = 2.0 * 3.0 * std::tan(20.0 * std::numbers::pi / 180.0) / 24.0;
    EXPECT_NEAR(static_cast<double>(hits), 0.5 / (pixel * pixel), 4.0 / pixel);
}

class ResumeTest : public testing::TestWithParam<const char*> {};

TEST_P(ResumeTest, GivesTheFramesOfAnUninterruptedRun) {
    const ScratchFolder folder;
    const Words render{"render",   "cornell",  "--size",   "24x16",      "--path",
                       GetParam(), "--frames", "6",        "--denoise",  "spatiotemporal",
                       "-o",       "f%d.exr",  "--report", "report.json"};
    runWell(folder, render);
    std::vector<ExrPicture> whole;
    for (std::size_t i = 0; i < 6; ++i) whole.push_back(pictureOf(folder, frameName(i)));
    for (const std::size_t first : {3U, 5U, 2U, 6U}) {
        for (std::size_t i = first; i < 6; ++i) std::filesystem::remove(folder.file(frameName(i)));
        folder.write("f1.exr", "is there");
        const Outcome outcome = runWell(folder, render + Words{"--resume"});
        EXPECT_EQ(folder.read("f1.exr"), "is there");
        for (std::size_t i = first; i < 6; ++i)
            EXPECT_TRUE(sameBits(pictureOf(folder, frameName(i)), whole[i]))
                << "frame " << i << ", from " << first;
        const std::string said = std::to_string(6 - first) + " of 6 frames";
        EXPECT_NE(outcome.out.find(said), std::string::npos) << outcome.out;
        const json report = json::parse(folder.read("report.json"));
        const json& frames = report.at("sequence").at("frames");
        EXPECT_EQ(frames.size(), 6 - first);
        EXPECT_EQ(report.at("outputs").size(), frames.size());
        EXPECT_NE(report.at("device"), "");
        for (std::size_t i = 0; i < frames.size(); ++i) EXPECT_EQ(frames[i].at("frame"), first + i);
    }
    // Nothing is drawn where all is there.
    EXPECT_EQ(json::parse(folder.read("report.json")).at("rays").at("primary"), 0);
}

INSTANTIATE_TEST_SUITE_P(Cli, ResumeTest, testing::Values("cut", "strafe"),
                         [](const testing::TestParamInfo<const char*>& path) {
                             return std::string(path.param);
                         });

TEST(Sequence, ResumesWhereOneOfTwoFilesIsMissing) {
    const ScratchFolder folder;
    const Words render{"render",   "cornell", "--size", "8x8",     "--path", "orbit",
                       "--frames", "3",       "-o",     "a%d.exr", "-o",     "b%d.png"};
    runWell(folder, render);
    std::filesystem::remove(folder.file("b1.png"));
    folder.write("a0.exr", "is there");
    EXPECT_NE(runWell(folder, render + Words{"--resume"}).out.find("2 of 3 frames"), std::string::npos);
    EXPECT_EQ(folder.read("a0.exr"), "is there");
    EXPECT_EQ(folder.contents().size(), 6U);
}

TEST(Sequence, AnInterruptionLeavesWholeFramesAndSaysHowToGoOn) {
    const ScratchFolder folder;
    RunningProgram program(folder, {"render", "cornell", "--size", "24x16", "--path", "orbit", "--frames",
                                    "100000", "-o", "f%d.exr", "-o", "f%d.png", "--report", "report.json"});
    ASSERT_TRUE(program.waitUntilCatches(SIGINT));
    while (!std::filesystem::exists(folder.file("f1.png")))
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    program.send(SIGINT);
    const Outcome outcome = program.wait();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("interrupted: "), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("--resume goes on"), std::string::npos) << outcome.err;
    const json report = json::parse(folder.read("report.json"));
    EXPECT_EQ(report.at("interrupted"), true);
    const std::size_t frames = report.at("sequence").at("frames").size();
    ASSERT_GE(frames, 2U);
    EXPECT_NE(outcome.err.find(std::to_string(frames) + " of 100000 frames"), std::string::npos);
    Words expected{"report.json"};
    for (std::size_t i = 0; i < frames; ++i) {
        expected.insert(expected.end(), {frameName(i), frameName(i, ".png")});
        EXPECT_EQ(pictureOf(folder, frameName(i)).width, 24);
    }
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(folder.contents(), expected);
}

TEST(Sequence, AFileThatFailsEndsIt) {
    const ScratchFolder folder;
    std::filesystem::create_directory(folder.file("gone"));
    RunningProgram program(folder, {"render", "cornell", "--size", "16x16", "--path", "orbit", "--frames",
                                    "100000", "-o", "gone/f%d.exr", "--report", "report.json"});
    while (!std::filesystem::exists(folder.file("gone/f0.exr")))
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    std::filesystem::rename(folder.file("gone"), folder.file("moved"));
    const Outcome outcome = program.wait();
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.err.find("gone/f"), std::string::npos) << outcome.err;
    EXPECT_TRUE(std::filesystem::exists(folder.file("report.json")));
}

struct BadPath {
    const char* name;
    const char* text;
    const char* says;
};

void PrintTo(const BadPath& bad, std::ostream* stream) {
    *stream << bad.text;
}

class BadPathTest : public testing::TestWithParam<BadPath> {};

TEST_P(BadPathTest, SaysOneLineAndLeavesNothing) {
    const ScratchFolder folder;
    folder.write("path.json", GetParam().text);
    const Outcome outcome = runLicht(folder, {"render", "cornell", "--size", "8x8", "--path", "path.json",
                                              "--frames", "2", "-o", "f%d.png"});
    EXPECT_EQ(outcome.exit_code, 2);
    ASSERT_EQ(outcome.errorLines().size(), 1U) << outcome.err;
    EXPECT_EQ(outcome.err.rfind("licht: ", 0), 0U) << outcome.err;
    EXPECT_NE(outcome.err.find(GetParam().says), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(folder.contents(), Words{"path.json"});
}

const BadPath kBadPaths[] = {
    {"Empty", "", "path.json: is no JSON"},
    {"NoJson", "keys: none", "path.json: is no JSON"},
    {"CutOff", R"({"keys": [{"time": 0, "cam)", "path.json: is no JSON"},
    {"NoObject", "[]", "path.json: has no list of 'keys'"},
    {"NoKeys", "{}", "path.json: has no list of 'keys'"},
    {"EmptyKeys", R"({"keys": []})", "path.json: has no list of 'keys'"},
    {"KeysOfAnotherKind", R"({"keys": {"time": 0}})", "path.json: has no list of 'keys'"},
    {"UnknownMemberOfThePath", R"({"keys": [{"time": 0, "camera": 0}], "fps": 3})",
     "path.json: has 'fps', which is none of keys"},
    {"KeyIsNoObject", R"({"keys": [0]})", "path.json: keys[0] is no object"},
    {"NoTime", R"({"keys": [{"camera": 0}]})", "keys[0] has no 'time'"},
    {"TimeIsText", R"({"keys": [{"time": "NaN", "camera": 0}]})",
     "keys[0] has no number up to 1e+15 as 'time'"},
    {"TimeIsNaN", R"({"keys": [{"time": NaN, "camera": 0}]})", "path.json: is no JSON"},
    {"TimeBeyondDoubles", R"({"keys": [{"time": 1e999, "camera": 0}]})", "path.json: is no JSON"},
    {"TimeBeyondAll", R"({"keys": [{"time": 1e16, "camera": 0}]})", "as 'time'"},
    {"TimeStandsStill", R"({"keys": [{"time": 1, "camera": 0}, {"time": 1, "camera": 0}]})",
     "keys[1] is not later"},
    {"TimeGoesBack",
     R"({"keys": [{"time": 1, "camera": 0}, {"time": 2, "camera": 0}, {"time": 1.5, "camera": 0}]})",
     "keys[2] is not later"},
    {"NoEye", R"({"keys": [{"time": 0, "target": [0, 0, 0]}]})", "keys[0] has neither 'camera' nor both"},
    {"NoTarget", R"({"keys": [{"time": 0, "eye": [0, 0, 0]}]})", "keys[0] has neither 'camera' nor both"},
    {"EyeIsTarget", R"({"keys": [{"time": 0, "eye": [1, 2, 3], "target": [1, 2, 3]}]})",
     "keys[0] looks at its own eye"},
    {"AlongUp", R"({"keys": [{"time": 0, "eye": [0, 0, 0], "target": [0, 5, 0]}]})",
     "keys[0] looks along its 'up'"},
    {"AlongAnotherUp",
     R"({"keys": [{"time": 0, "eye": [0, 0, 0], "target": [1, 1, 1], "up": [-2, -2, -2]}]})",
     "keys[0] looks along its 'up'"},
    {"NoUp", R"({"keys": [{"time": 0, "eye": [0, 0, 0], "target": [1, 1, 1], "up": [0, 0, 0]}]})",
     "keys[0] looks along its 'up'"},
    {"EyeOfTwo", R"({"keys": [{"time": 0, "eye": [0, 0], "target": [1, 1, 1]}]})", "as 'eye'"},
    {"EyeOfText", R"({"keys": [{"time": 0, "eye": [0, 0, "0"], "target": [1, 1, 1]}]})", "as 'eye'"},
    {"EyeBeyondAll", R"({"keys": [{"time": 0, "eye": [0, 0, 1e16], "target": [1, 1, 1]}]})", "as 'eye'"},
    {"UnknownMember", R"({"keys": [{"time": 0, "camera": 0, "speed": 1}]})",
     "keys[0] has 'speed', which is none of time, camera, eye, target, up, yfov, cut"},
    {"UnknownCamera", R"({"keys": [{"time": 0, "camera": "nobody"}]})", "keys[0] asks for camera 'nobody'"},
    {"CameraOutOfRange", R"({"keys": [{"time": 0, "camera": 77}]})", "keys[0] asks for camera '77'"},
    {"CameraOfAnotherKind", R"({"keys": [{"time": 0, "camera": -1}]})", "as 'camera'"},
    {"CameraAndEye", R"({"keys": [{"time": 0, "camera": 0, "eye": [0, 0, 0], "target": [1, 1, 1]}]})",
     "keys[0] has both 'camera' and 'eye'"},
    {"CameraAndUp", R"({"keys": [{"time": 0, "camera": 0, "up": [0, 0, 1]}]})",
     "keys[0] has both 'camera' and"},
    {"NoAngle", R"({"keys": [{"time": 0, "camera": 0, "yfov": 0}]})", "not between 0 and 180"},
    {"HalfTurn", R"({"keys": [{"time": 0, "camera": 0, "yfov": 180}]})", "not between 0 and 180"},
    {"AlmostHalfTurn", R"({"keys": [{"time": 0, "camera": 0, "yfov": 179.9999999}]})",
     "not between 0 and 180"},
    {"AngleTooNarrow", R"({"keys": [{"time": 0, "camera": 0, "yfov": 1e-9}]})", "too narrow"},
    {"CutIsNoFlag", R"({"keys": [{"time": 0, "camera": 0, "cut": 1}]})",
     "keys[0] has neither true nor false"},
};

INSTANTIATE_TEST_SUITE_P(Cli, BadPathTest, testing::ValuesIn(kBadPaths),
                         [](const testing::TestParamInfo<BadPath>& bad) { return bad.param.name; });

}  // namespace
}  // namespace licht::test
