// A device may fail at every call, and may never finish: one line, exit code 1, and no file that is half
// there. The layer in faults/ makes it so.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <map>
#include <sstream>
#include <tuple>

#include "licht/core/file.h"
#include "licht/image/exr.h"
#include "licht/image/files.h"
#include "run_program.h"

namespace licht::test {
namespace {

using Words = std::vector<std::string>;

/// What is run, and the files that it makes.
struct Task {
    const char* name;
    Words arguments;
    Words files;
    const char* depth;  ///< of its places, see faults/layer.cpp
};

void PrintTo(const Task& task, std::ostream* stream) {
    *stream << task.name;
}

const Task kTasks[] = {{"Render",
                        {"render", "cornell", "--size", "8", "--spp", "2", "--bounces", "2", "-o", "a.png",
                         "-o", "a.exr", "--report", "r.json", "--quiet"},
                        {"a.exr", "a.png", "r.json"},
                        "2"},
                       {"RenderByQueues",
                        {"render", "quad.gltf", "--size", "8", "--spp", "2", "--bounces", "2", "--queues",
                         "--adaptive", "--aov", "all", "--background", "1,1,1", "-o", "a.exr", "--quiet"},
                        {"a.exr"},
                        "2"},
                       {"Bench",
                        {"bench", "cornell", "--size", "8", "--runs", "1", "--json", "b.json", "--quiet"},
                        {"b.json"},
                        "1"},
                       {"Devices", {"devices"}, {}, "2"}};

/// A textured quad.
const char* const kQuad =
    R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
"materials": [{"alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
"textures": [{"source": 0}],
"images": [{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR4nGM4kWLUAAAFNQHfc2Lj2wAAAABJRU5ErkJggg=="}],
"accessors": [{"count": 3, "type": "VEC3", "componentType": 5126, "bufferView": 0, "min": [0, 0, 0], "max": [1, 1, 0]},
{"count": 3, "type": "VEC2", "componentType": 5126, "bufferView": 0}],
"bufferViews": [{"buffer": 0, "byteLength": 36}],
"buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";

bool nightly() {
    return std::getenv("LICHT_NIGHTLY") != nullptr;
}

Outcome runUnder(const ScratchFolder& folder, const Task& task, const Environment& faults) {
    // Mesa's own layer above does not look at what its calls give back.
    Environment environment{{"LICHT_VALIDATION", "0"},
                            {"NODEVICE_SELECT", "1"},
                            {"VK_LAYER_PATH", LICHT_FAULTS},
                            {"VK_INSTANCE_LAYERS", "VK_LAYER_LICHT_faults"}};
    environment.emplace_back("LICHT_FAULTS_DEPTH", nightly() ? "4" : task.depth);
    environment.insert(environment.end(), faults.begin(), faults.end());
    folder.write("quad.gltf", kQuad);
    return runLicht(folder, task.arguments, environment);
}

Words linesOf(const std::string& text) {
    Words lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

/// Every place of that task that calls Vulkan.
Words placesOf(const Task& task) {
    const ScratchFolder folder;
    const ScratchFolder list;
    const Outcome outcome = runUnder(folder, task, {{"LICHT_FAULTS_LIST", list.file("places")}});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return linesOf(list.read("places"));
}

/// Reads it as what its name says it is; throws where it is not.
void expectWhole(const ScratchFolder& folder, const std::string& name) {
    const std::filesystem::path path = folder.path() / name;
    if (name.ends_with(".png")) {
        EXPECT_NO_THROW(decodeImage(readFile(path), name));
    } else if (name.ends_with(".exr")) {
        EXPECT_NO_THROW(readExr(path));
    } else {
        EXPECT_TRUE(folder.read(name).ends_with("}\n")) << name;
    }
}

/// What holds after any failure: all is there, or one line says why not and no file is half there.
void expectClean(const ScratchFolder& folder, const Task& task, const Outcome& outcome) {
    Words there;
    for (const std::string& name : folder.contents())
        if (name != "quad.gltf") there.push_back(name);
    for (const std::string& name : there) {
        EXPECT_NE(std::find(task.files.begin(), task.files.end(), name), task.files.end()) << name;
        expectWhole(folder, name);
    }
    if (outcome.exit_code == 0) {
        EXPECT_EQ(there, task.files);
        return;
    }
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(outcome.errorLines().size(), 1U) << outcome.err;
    EXPECT_EQ(outcome.err.rfind("licht: ", 0), 0U) << outcome.err;
}

constexpr std::size_t kParts = 4;
class DeviceFaults : public testing::TestWithParam<std::tuple<Task, std::size_t>> {};

TEST_P(DeviceFaults, EveryCallMayFailOnce) {
    const auto& [task, part] = GetParam();
    const Words places = placesOf(task);
    ASSERT_GE(places.size(), 3U);
    std::map<std::string, int> failures;
    for (std::size_t i = part; i < places.size(); i += kParts) {
        SCOPED_TRACE(places[i]);
        const ScratchFolder folder;
        const Outcome outcome = runUnder(folder, task, {{"LICHT_FAULTS_AT", places[i]}});
        expectClean(folder, task, outcome);
        failures[places[i].substr(0, places[i].find('.'))] += outcome.exit_code == 0 ? 0 : 1;
        if (HasFailure()) return;
    }
    for (const auto& [function, count] : failures)
        std::cout << function << ": " << count << " failures said\n";
}

INSTANTIATE_TEST_SUITE_P(Cli, DeviceFaults,
                         testing::Combine(testing::ValuesIn(kTasks), testing::Range<std::size_t>(0, kParts)),
                         [](const testing::TestParamInfo<std::tuple<Task, std::size_t>>& named) {
                             return std::string(std::get<0>(named.param).name) +
                                    std::to_string(std::get<1>(named.param));
                         });

class HungDevice : public testing::TestWithParam<Task> {};

// Nightly every submission of a run, else the first ones and fewer of the later ones.
TEST_P(HungDevice, IsGivenUpWhicheverSubmissionItIs) {
    int hung = 0;
    for (int submission = 1;; submission += nightly() ? 1 : 1 + submission / 2) {
        SCOPED_TRACE(submission);
        const ScratchFolder folder;
        const Outcome outcome =
            runUnder(folder, GetParam(), {{"LICHT_FAULTS_HANG", std::to_string(submission)}});
        expectClean(folder, GetParam(), outcome);
        if (HasFailure()) return;
        if (outcome.exit_code == 0) break;
        EXPECT_NE(outcome.err.find("did not finish"), std::string::npos) << outcome.err;
        ++hung;
    }
    EXPECT_GE(hung, 2);
}

INSTANTIATE_TEST_SUITE_P(Cli, HungDevice, testing::ValuesIn(kTasks, kTasks + 2),
                         [](const testing::TestParamInfo<Task>& named) {
                             return std::string(named.param.name);
                         });

}  // namespace
}  // namespace licht::test
