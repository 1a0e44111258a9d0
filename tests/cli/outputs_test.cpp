// What a command gives away never harms what it takes, and is not lost to a stream.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "licht/image/exr.h"
#include "licht/image/files.h"
#include "run_program.h"

namespace licht {
namespace {

using test::Outcome;
using test::runLicht;
using test::ScratchFolder;

/// A scene with a texture of its own name, a sky beside it, and links to both.
void writeInputs(const ScratchFolder& folder) {
    writePng(folder.file("Crate.png"), Image(1, 1, 3));
    ExrPicture sky;
    sky.width = sky.height = 1;
    for (const char* name : {"R", "G", "B"}) sky.channels.push_back({name, {1.0F}});
    writeExr(folder.file("sky.exr"), sky);
    // Triangle and indices: three vertices of three floats, as base64.
    folder.write("Crate.gltf", R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],"textures":[{"source":0}],
"images":[{"uri":"Crate.png"}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,
"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
    std::filesystem::create_hard_link(folder.file("sky.exr"), folder.file("linked.exr"));
    std::filesystem::create_hard_link(folder.file("Crate.png"), folder.file("Crate-02.png"));
    folder.write("path.json", R"({"keys": [{"time": 0, "eye": [0, 0, 1], "target": [0, 0, 0]}]})");
    std::filesystem::create_directory(folder.file("sub"));
    std::filesystem::create_symlink("../Crate.gltf", folder.file("sub/link.json"));
}

struct Refused {
    const char* name;
    std::vector<std::string> arguments;
};

class OutputsTest : public testing::TestWithParam<Refused> {};

TEST_P(OutputsTest, AreNoInputsAndNoOtherOutputs) {
    const ScratchFolder folder;
    writeInputs(folder);
    const std::vector<std::string> before = folder.contents();
    std::vector<std::string> bytes;
    for (const char* name : {"Crate.gltf", "Crate.png", "sky.exr", "path.json"})
        bytes.push_back(folder.read(name));
    std::vector<std::string> arguments = GetParam().arguments;
    if (arguments[0] == "render") arguments.insert(arguments.end(), {"--size", "8x8", "--spp", "1"});
    if (arguments[0] == "accuracy")
        arguments.insert(arguments.end(), {"--size", "8x8", "--frames", "1", "--reference-spp", "2"});
    const Outcome outcome = runLicht(folder, arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.errorLines().size(), 1U) << outcome.err;
    EXPECT_EQ(folder.contents(), before);
    std::size_t i = 0;
    for (const char* name : {"Crate.gltf", "Crate.png", "sky.exr", "path.json"})
        EXPECT_EQ(folder.read(name), bytes[i++]) << name;
}

INSTANTIATE_TEST_SUITE_P(
    Cli, OutputsTest,
    testing::Values(
        Refused{"texture", {"render", "Crate.gltf", "-o", "Crate.png"}},
        Refused{"textureByAnotherSpelling", {"render", "Crate.gltf", "-o", "sub/../Crate.png"}},
        Refused{"sky", {"render", "Crate.gltf", "--environment", "sky.exr", "-o", "sky.exr"}},
        Refused{"skyByAHardLink", {"render", "Crate.gltf", "--environment", "sky.exr", "-o", "linked.exr"}},
        Refused{"sceneByALink", {"render", "Crate.gltf", "-o", "a.png", "--report", "sub/link.json"}},
        Refused{"reportIsThePicture", {"render", "cornell", "-o", "a.exr", "--report", "./a.exr"}},
        Refused{"twoPictures", {"render", "cornell", "-o", "a.exr", "-o", "sub/../a.exr"}},
        Refused{"textureByAFrame", {"render", "Crate.gltf", "--path", "orbit", "-o", "Crate-%02d.png"}},
        Refused{"pathByTheReport",
                {"render", "Crate.gltf", "--path", "path.json", "-o", "f%d.png", "--report", "path.json"}},
        Refused{"pathByAccuracy",
                {"accuracy", "Crate.gltf", "--temporal", "--path", "path.json", "--json", "path.json"}},
        Refused{"skyByAccuracy",
                {"accuracy", "Crate.gltf", "--temporal", "--environment", "sky.exr", "--csv", "linked.exr"}},
        Refused{"compareReference", {"compare", "sky.exr", "sky.exr", "--json", "linked.exr"}},
        Refused{"benchScene", {"bench", "Crate.gltf", "--json", "Crate.gltf", "--quiet"}}),
    [](const testing::TestParamInfo<Refused>& param) { return std::string(param.param.name); });

// Nobody named it, so nobody agreed to lose it.
TEST(Outputs, TheDefaultReplacesLichtsOwnPicturesAlone) {
    const ScratchFolder folder;
    folder.write("cornell.png", "somebody's");
    const std::vector<std::string> render{"render", "cornell", "--size", "8x8", "--spp", "1", "--quiet"};
    EXPECT_EQ(runLicht(folder, render).exit_code, 2);
    EXPECT_EQ(folder.read("cornell.png"), "somebody's");
    std::filesystem::remove(folder.file("cornell.png"));
    EXPECT_EQ(runLicht(folder, render).exit_code, 0);
    EXPECT_EQ(runLicht(folder, render).exit_code, 0);
    const std::string png = folder.read("cornell.png");
    EXPECT_EQ(decodeImage(std::as_bytes(std::span(png)), "cornell.png").width, 8);
}

// A name may be any bytes; JSON is UTF-8.
TEST(Outputs, NamesThatAreNoTextLeaveJsonValid) {
    const ScratchFolder folder;
    writeInputs(folder);
    const std::string scene = "\xff\xc3.gltf";
    std::filesystem::copy_file(folder.file("Crate.gltf"), folder.file(scene));
    const std::vector<std::vector<std::string>> commands{
        {"render", scene, "--size", "8x8", "--spp", "1", "-o", "\xfe.exr", "--report", "json", "--quiet"},
        {"bench", scene, "--size", "8", "--runs", "1", "--json", "json", "--quiet"},
        {"compare", "\xfe.exr", "\xfe.exr", "--json", "json"}};
    for (const std::vector<std::string>& command : commands) {
        std::filesystem::remove(folder.file("json"));
        EXPECT_EQ(runLicht(folder, command).exit_code, 0) << command[0];
        EXPECT_TRUE(nlohmann::json::accept(folder.read("json"))) << command[0];
    }
    EXPECT_TRUE(nlohmann::json::accept(runLicht(folder, {"info", scene, "--json"}).out));
}

/// Exit code of the command as a shell runs it in the folder.
int shell(const ScratchFolder& folder, const std::string& arguments, const std::string& before = "true") {
    const std::string command = "cd '" + folder.path().string() + "' && " + before +
                                " && LICHT_VALIDATION=1 '" + LICHT_PROGRAM + "' " + arguments;
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

bool has(const ScratchFolder& folder, const std::string& name) {
    return std::filesystem::exists(folder.file(name));
}

// A closed descriptor would be the next file's: what is meant for the terminal would land in the picture.
TEST(Streams, APictureIsNotLostToThem) {
    const std::string render = "render cornell --size 8x8 --spp 1 --clamp 0.001 ";
    for (const char* streams :
         {"2>&-", "2>/dev/full", ">&- 2>&-", ">/dev/full 2>/dev/null", "<&- >&- 2>/dev/null"}) {
        const ScratchFolder folder;
        EXPECT_EQ(shell(folder, render + "-o a.exr -o b.png --report r.json " + streams), 0) << streams;
        EXPECT_NO_THROW(readExr(folder.file("a.exr"))) << streams;
        EXPECT_TRUE(has(folder, "b.png") && has(folder, "r.json")) << streams;
    }
    const ScratchFolder folder;
    EXPECT_EQ(shell(folder, "render nothing 2>&-"), 2);
}

// 64 blocks of 512 bytes, beyond which the system sends a signal.
TEST(Outputs, OneThatIsTooLargeForALimitLeavesNoPart) {
    const ScratchFolder folder;
    const char* render = "render cornell --size 128x128 --spp 1 -o a.exr --report r.json --quiet 2>/dev/null";
    EXPECT_EQ(shell(folder, render, "ulimit -f 64"), 1);
    EXPECT_EQ(folder.contents(), std::vector<std::string>{"r.json"});
}

TEST(Streams, TextThatIsTheWorkIsMissed) {
    const ScratchFolder folder;
    for (const char* command : {"info cornell", "info cornell --json", "devices --json", "--help"}) {
        EXPECT_EQ(shell(folder, std::string(command) + " >/dev/full 2>/dev/null"), 1) << command;
        EXPECT_EQ(shell(folder, std::string(command) + " >&- 2>/dev/null"), 1) << command;
    }
}

// The folder of the first goes while the picture is made.
TEST(Outputs, OneThatFailsTakesNoOtherAlong) {
    const ScratchFolder folder;
    std::filesystem::create_directory(folder.file("gone"));
    test::RunningProgram program(folder, {"render", "cornell", "--size", "16x16", "--spp", "4294967295", "-o",
                                          "gone/a.exr", "-o", "good.png", "--report", "r.json"});
    ASSERT_TRUE(program.waitUntilCatches(SIGINT));
    std::filesystem::remove_all(folder.file("gone"));
    program.send(SIGINT);
    const Outcome outcome = program.wait();
    EXPECT_EQ(outcome.exit_code, 1) << "no fault of the input";
    EXPECT_NE(outcome.err.find("gone/a.exr"), std::string::npos);
    EXPECT_TRUE(has(folder, "good.png") && has(folder, "r.json"));
}

}  // namespace
}  // namespace licht
