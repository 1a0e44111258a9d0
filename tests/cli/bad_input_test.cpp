// Every wrong use: exit code 2, one line that says what is wrong, and nothing left behind.
#include <gtest/gtest.h>

#include "run_program.h"

namespace licht::test {
namespace {

using Words = std::vector<std::string>;

struct BadInput {
    const char* name;
    Words arguments;
    const char* says;  ///< part of the line
};

void PrintTo(const BadInput& bad, std::ostream* stream) {
    *stream << testing::PrintToString(bad.arguments);
}

class BadInputTest : public testing::TestWithParam<BadInput> {};

TEST_P(BadInputTest, SaysOneLineAndLeavesNothing) {
    const ScratchFolder folder;
    folder.write("cut.glb", std::string("glTF\x02\0\0\0\x00\x10\0\0\x00\x08\0\0JSON{\"asset\"", 31));
    folder.write("bad.hdr", "this is no picture");
    folder.write("notes.txt", "neither is this");
    std::filesystem::create_directory(folder.path() / "folder");
    std::filesystem::create_directory(folder.path() / "folder.png");
    for (const char* name : {"folder.glb", "folder.json", "taken-5.png"})
        std::filesystem::create_directory(folder.path() / name);
    const Words before = folder.contents();

    const Outcome outcome = runLicht(folder, GetParam().arguments);

    EXPECT_EQ(outcome.exit_code, 2);
    ASSERT_EQ(outcome.errorLines().size(), 1U) << outcome.err;
    EXPECT_EQ(outcome.err.rfind("licht: ", 0), 0U) << outcome.err;
    EXPECT_NE(outcome.err.find(GetParam().says), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(folder.contents(), before);
}

const BadInput kBadInputs[] = {
    {"NoSubcommand", {}, "subcommand"},
    {"UnknownSubcommand", {"paint"}, "paint"},
    {"UnknownFlag", {"render", "empty", "--frobnicate"}, "--frobnicate"},
    {"UnknownOptionsInTheirOrder",
     {"render", "cornell", "--sppp", "4", "--foo=1", "--siez", "32"},
     "unknown: --sppp (did you mean --spp?), --foo, --siez (did you mean --size?) (see 'licht render "
     "--help')"},
    {"ValueOfAnUnknownOptionIsNotTheFault",
     {"render", "--sppp", "4", "cornell"},
     "unknown: --sppp (did you mean --spp?) (see"},
    {"WordTooMany", {"render", "cornell", "empty"}, "unexpected: 'empty'"},
    {"QueuesOfAnotherWord", {"render", "cornell", "--queues=maybe"}, "--queues 'maybe'"},
    {"NoScene", {"render"}, "SCENE"},
    {"MissingFile", {"render", "missing.glb"}, "missing.glb"},
    {"UnknownScene", {"render", "missing"}, "missing"},
    {"TruncatedGlb", {"render", "cut.glb"}, "cut.glb"},
    {"FolderAsScene", {"render", "folder"}, "folder"},
    {"FolderNamedAsScene", {"render", "folder.glb"}, "folder.glb"},
    {"OtherFileAsScene", {"render", "notes.txt"}, "notes.txt"},
    {"MissingFileInfo", {"info", "missing.glb"}, "missing.glb"},
    {"TruncatedGlbInfo", {"info", "cut.glb"}, "cut.glb"},
    {"ZeroSize", {"render", "empty", "--size", "0x0"}, "--size '0x0'"},
    {"HugeSize", {"render", "empty", "--size", "99999999999x9"}, "--size"},
    {"TooManyPixels", {"render", "empty", "--size", "16384x16384"}, "--size"},
    {"PictureBeyondMemory",
     {"render", "empty", "--size", "4096x4096", "--memory-limit", "1G"},
     "a picture of 4096x4096 takes about"},
    {"MemoryWithoutUnit", {"render", "empty", "--memory-limit", "100"}, "--memory-limit '100'"},
    {"TooLittleMemory", {"info", "empty", "--memory-limit", "1M"}, "at least 16M"},
    {"SizeOfNothing", {"render", "empty", "--size", "x"}, "--size 'x'"},
    {"CompletedSizeTooLarge", {"render", "empty", "--size", "16384"}, "--size: 16384x9216"},
    {"RotationIsNoNumber",
     {"render", "cornell", "--environment-rotation", "east"},
     "--environment-rotation 'east'"},
    {"NoSkyToTurn", {"render", "cornell", "--environment-rotation", "90"}, "no sky to turn"},
    {"NoStrength", {"render", "empty", "--environment-strength", "0"}, "--environment-strength '0'"},
    {"StrengthBeyondFloats",
     {"render", "empty", "--background", "1e30,1,1", "--environment-strength", "1e30"},
     "--environment-strength 1e+30: a texel of 1e+30 cd/m^2 grows out of range"},
    {"NegativeSamples", {"render", "empty", "--spp", "-1"}, "--spp '-1'"},
    {"ZeroSamples", {"render", "empty", "--spp", "0"}, "--spp '0'"},
    {"TooManySamples", {"render", "empty", "--spp", "4294967296"}, "--spp"},
    {"NegativeBounces", {"render", "empty", "--bounces", "-1"}, "--bounces '-1'"},
    {"TooManyBounces", {"render", "empty", "--bounces", "65536"}, "--bounces"},
    {"QueuesOfTooManyBounces", {"render", "cornell", "--queues", "--bounces", "41"}, "40 bounces"},
    {"BouncesOfAnotherWord", {"render", "empty", "--bounces", "automatic"}, "--bounces 'automatic'"},
    {"ZeroClamp", {"render", "empty", "--clamp", "0"}, "--clamp '0'"},
    {"NegativeClamp", {"render", "empty", "--clamp", "-1"}, "--clamp '-1'"},
    {"ClampIsNoNumber", {"render", "empty", "--clamp", "nan"}, "--clamp 'nan'"},
    {"ClampBeyondFloats", {"render", "empty", "--clamp", "1e39"}, "--clamp '1e39'"},
    {"ViewerChoosesNoBounces", {"view", "empty", "--bounces", "auto"}, "--bounces 'auto'"},
    {"RegulariseTakesNothing", {"render", "empty", "--regularise=much"}, "--regularise"},
    {"DenoiseNeedsSamplesInEveryPixel",
     {"render", "empty", "--size", "16x16", "--spp", "4", "--adaptive", "--denoise", "spatiotemporal"},
     "--adaptive"},
    {"AdaptiveTakesNothing", {"render", "empty", "--adaptive=soon"}, "--adaptive"},
    {"OrdersWithoutFile", {"render", "empty", "-o", "a.png", "--aov", "bounces"}, "--aov bounces"},
    {"OrdersBeyondTheDevice",
     {"render", "cornell", "-o", "a.exr", "--aov", "bounces", "--bounces", "65535"},
     "65536 layers"},
    {"NegativeSeed", {"render", "empty", "--seed", "-5"}, "--seed"},
    {"ZeroTime", {"render", "empty", "--time", "0"}, "--time '0'"},
    {"InfiniteTime", {"render", "empty", "--time", "inf"}, "--time"},
    {"ErrorIsNoNumber", {"render", "empty", "--error", "nan"}, "--error"},
    {"ExposureWithUnit", {"render", "empty", "--exposure", "1EV"}, "--exposure"},
    {"UnknownTonemap", {"render", "empty", "--tonemap", "sepia"}, "agx"},
    {"UnknownLayer", {"render", "empty", "-o", "a.exr", "--aov", "albedo,shininess"}, "shininess"},
    {"LayersWithoutExr", {"render", "empty", "-o", "a.png", "--aov", "albedo"}, "--aov"},
    {"SunWiderThanTheSky", {"render", "empty", "--sun-angle", "181"}, "--sun-angle"},
    {"NoSunAngle", {"render", "empty", "--sun-angle", "nan"}, "--sun-angle"},
    {"NegativeBackground", {"render", "empty", "--background", "1,-1,1"}, "--background"},
    {"BackgroundOfTwo", {"render", "empty", "--background", "1,1"}, "--background"},
    {"BackgroundAndEnvironment",
     {"render", "empty", "--background", "1,1,1", "--environment", "bad.hdr"},
     "--environment"},
    {"BadEnvironment", {"render", "empty", "--environment", "bad.hdr"}, "bad.hdr"},
    {"MissingEnvironment", {"render", "empty", "--environment", "missing.exr"}, "missing.exr"},
    {"OtherEnvironment", {"render", "empty", "--environment", "notes.txt"}, "notes.txt"},
    {"UnknownCamera", {"render", "cornell", "--camera", "nobody"}, "nobody"},
    {"CameraOutOfRange", {"render", "cornell", "--camera", "77"}, "77"},
    {"OtherOutput", {"render", "empty", "-o", "picture.jpg"}, "picture.jpg"},
    {"OutputIsFolder", {"render", "empty", "-o", "folder.png"}, "folder.png"},
    {"OutputInMissingFolder", {"render", "empty", "-o", "nowhere/picture.png"}, "nowhere"},
    {"UnwritableOutput", {"render", "empty", "-o", "/proc/picture.png"}, "/proc"},
    {"SecondOutputUnwritable", {"render", "empty", "-o", "good.png", "-o", "/proc/picture.exr"}, "/proc"},
    {"UnwritableReport", {"render", "empty", "--report", "/proc/report.json"}, "/proc"},
    {"ReportIsFolder", {"render", "empty", "--report", "folder"}, "folder"},
    {"UnknownDevice", {"render", "empty", "--device", "abacus"}, "abacus"},
    {"PathOfNoName",
     {"render", "cornell", "--path", "spiral"},
     "--path spiral: is none of orbit, strafe, cut, rest, still-move-still, and no .json file"},
    {"PathFileMissing", {"render", "cornell", "--path", "missing.json"}, "missing.json: no such file"},
    {"PathFileIsFolder", {"render", "cornell", "--path", "folder.json"}, "folder.json"},
    {"NoFrames", {"render", "cornell", "--path", "orbit", "--frames", "0"}, "--frames '0'"},
    {"TooManyFrames", {"render", "cornell", "--path", "orbit", "--frames", "1000001"}, "--frames"},
    {"NoRate", {"render", "cornell", "--path", "orbit", "--fps", "0"}, "--fps '0'"},
    {"NegativeRate", {"render", "cornell", "--path", "orbit", "--fps", "-1"}, "--fps '-1'"},
    {"RateIsNoNumber", {"render", "cornell", "--path", "orbit", "--fps", "nan"}, "--fps 'nan'"},
    {"FramesWithoutPath", {"render", "cornell", "--frames", "3"}, "--path"},
    {"RateWithoutPath", {"render", "cornell", "--fps", "3"}, "--path"},
    {"UnfilteredOfWhatIsNotFiltered", {"render", "cornell", "--unfiltered", "a.png"}, "--unfiltered"},
    {"UnfilteredInNoPng",
     {"render", "cornell", "--denoise", "spatiotemporal", "--unfiltered", "a.exr"},
     "--unfiltered 'a.exr'"},
    {"UnfilteredOverTheFiltered",
     {"render", "cornell", "--denoise", "spatiotemporal", "--unfiltered", "a.png", "-o", "a.png"},
     "a.png"},
    {"AViewOfAnotherFilter", {"view", "cornell", "--denoise", "oidn"}, "none, temporal, spatiotemporal"},
    {"ResumeWithoutPath", {"render", "cornell", "--resume"}, "--path"},
    {"FramesWithoutNumber", {"render", "cornell", "--path", "orbit", "-o", "f.exr"}, "f.exr: the name of"},
    {"FramesOfTwoNumbers", {"render", "cornell", "--path", "orbit", "-o", "%d-%d.exr"}, "has one number"},
    {"FramesOfText", {"render", "cornell", "--path", "orbit", "-o", "f-%s.exr"}, "has one number"},
    {"FramesOfASign", {"render", "cornell", "--path", "orbit", "-o", "%.exr"}, "has one number"},
    {"FoldersOfNumbers", {"render", "cornell", "--path", "orbit", "-o", "%d/f.exr"}, "has one number"},
    {"FramesInMissingFolder", {"render", "cornell", "--path", "orbit", "-o", "nowhere/%d.exr"}, "nowhere"},
    {"AFrameIsAFolder",
     {"render", "cornell", "--path", "orbit", "--frames", "8", "-o", "taken-%d.png"},
     "taken-5.png: cannot write, it is a folder"},
    {"OneFileForAFrameTwice",
     {"render", "cornell", "--path", "orbit", "-o", "f%d.exr", "-o", "./f%d.exr"},
     "f0.exr is written there too"},
    {"OneFileForTwoFrames",
     {"render", "cornell", "--path", "orbit", "--size", "8", "--frames", "12", "-o", "1%d.png", "-o",
      "./%d.png"},
     "10.png: cannot write, it is named for two files"},
    {"AFrameIsTheReport",
     {"render", "cornell", "--path", "orbit", "--size", "8", "--frames", "4", "-o", "f%d.png", "--report",
      "f3.png"},
     "f3.png: cannot write, it is named for two files"},
    {"FramesUntilATime", {"render", "cornell", "--path", "orbit", "--time", "1"}, "leave out --time"},
    {"FramesUntilAnError", {"render", "cornell", "--path", "orbit", "--error", "1"}, "leave out --time"},
    {"AdaptiveFrames", {"render", "cornell", "--path", "orbit", "--adaptive"}, "and --adaptive"},
    {"FramesOfMoreSamplesThanThereAre",
     {"render", "cornell", "--path", "orbit", "--frames", "3", "--spp", "1431655766"},
     "--frames 3 of --spp 1431655766: sample indices end at 4294967295"},
    {"AccuracyOfWhat", {"accuracy", "cornell"}, "--temporal"},
    {"AccuracyOfNoPath", {"accuracy", "cornell", "--temporal", "--path", "spiral"}, "--path spiral"},
    {"AccuracyOfNoFrames", {"accuracy", "cornell", "--temporal", "--frames", "0"}, "--frames '0'"},
    {"AccuracyOfNoSamples", {"accuracy", "cornell", "--temporal", "--spp", "0"}, "--spp '0'"},
    {"ReferenceOfOneSample",
     {"accuracy", "cornell", "--temporal", "--reference-spp", "1"},
     "--reference-spp '1'"},
    {"AccuracyOfMoreSamplesThanThereAre",
     {"accuracy", "cornell", "--temporal", "--frames", "3", "--spp", "1431655766"},
     "--frames 3 of --spp 1431655766"},
    {"AccuracyUnwritable", {"accuracy", "cornell", "--temporal", "--svg", "nowhere/a.svg"}, "nowhere"},
    {"AccuracyInOneFile",
     {"accuracy", "cornell", "--temporal", "--csv", "a.txt", "--json", "./a.txt"},
     "a.txt: cannot write"},
    {"AccuracyOfAnUnknownScene", {"accuracy", "missing", "--temporal"}, "missing"},
    {"TooLateFirstSample",
     {"render", "empty", "--first-sample", "4294967290", "--spp", "100"},
     "--first-sample"},
};

INSTANTIATE_TEST_SUITE_P(Cli, BadInputTest, testing::ValuesIn(kBadInputs),
                         [](const testing::TestParamInfo<BadInput>& bad) { return bad.param.name; });

TEST(BadInput, LineBreaksInAFileNameStayInOneLine) {
    const ScratchFolder folder;
    const Outcome outcome = runLicht(folder, {"render", "two\nlines.glb"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.errorLines().size(), 1U) << outcome.err;
}

TEST(BadInput, NoDisplayForTheViewer) {
    const ScratchFolder folder;
    for (const char* nowhere : {"", ":4711"}) {
        const Outcome outcome =
            runLicht(folder, {"view", "empty"},
                     {{"DISPLAY", nowhere}, {"WAYLAND_DISPLAY", ""}, {"XDG_RUNTIME_DIR", ""}});
        EXPECT_EQ(outcome.exit_code, 2);
        ASSERT_EQ(outcome.errorLines().size(), 1U) << outcome.err;
        EXPECT_NE(outcome.err.find("licht render"), std::string::npos) << outcome.err;
    }
}

TEST(BadInput, NoVulkanDriverIsADeviceFailure) {
    const ScratchFolder folder;
    // The old and the new name of the variable that tells the loader where drivers are.
    const Environment no_driver{
        {"VK_ICD_FILENAMES", "/nowhere"}, {"VK_DRIVER_FILES", "/nowhere"}, {"LICHT_VALIDATION", "0"}};
    for (const Words& arguments : {Words{"devices"}, Words{"render", "empty"}}) {
        const Outcome outcome = runLicht(folder, arguments, no_driver);
        EXPECT_EQ(outcome.exit_code, 1);
        EXPECT_EQ(outcome.errorLines().size(), 1U) << outcome.err;
        EXPECT_EQ(outcome.err.rfind("licht: ", 0), 0U) << outcome.err;
    }
    EXPECT_TRUE(folder.contents().empty());
}

}  // namespace
}  // namespace licht::test
