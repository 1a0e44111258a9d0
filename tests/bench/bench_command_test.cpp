// `licht bench` as its users meet it.
#include <gtest/gtest.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"

namespace licht::test {
namespace {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

Json benchOf(const Words& what) {
    const ScratchFolder folder;
    Words words{"bench", "--size", "48x27", "--runs", "2", "--json", "out.json"};
    words.insert(words.end(), what.begin(), what.end());
    const Outcome outcome = runLicht(folder, words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("bounce2"), std::string::npos) << outcome.out;
    return Json::parse(folder.read("out.json"));
}

void expectPositive(const Json& holder, const char* field) {
    ASSERT_TRUE(holder.contains(field)) << field;
    ASSERT_TRUE(holder[field].is_number()) << field;
    EXPECT_GT(holder[field].get<double>(), 0.0) << field;
}

void expectKind(const Json& rays) {
    expectPositive(rays, "count");
    expectPositive(rays, "mrays_per_second");
    expectPositive(rays, "nodes_per_ray");
    ASSERT_TRUE(rays["triangles_per_ray"].is_number());
    EXPECT_EQ(rays["truncated_traversals"], 0);
    const auto spread = rays["mrays_per_second_spread"];
    EXPECT_LE(spread[0], rays["mrays_per_second"]);
    EXPECT_GE(spread[1], rays["mrays_per_second"]);
#if LICHT_HAS_EMBREE
    expectPositive(rays, "embree1_mrays_per_second");
    expectPositive(rays, "embree1_ratio");
    expectPositive(rays, "embree_packet_ratio");
    EXPECT_EQ(rays["mismatches"], 0);
#else
    for (const char* field :
         {"embree1_mrays_per_second", "embree1_ratio", "embree_packet_ratio", "mismatches"}) {
        ASSERT_TRUE(rays.contains(field)) << field;
        EXPECT_TRUE(rays[field].is_null()) << field;
    }
#endif
}

class BenchScene : public testing::TestWithParam<const char*> {};

TEST_P(BenchScene, SaysEverythingAndAgreesWithEmbree) {
#if !LICHT_HAS_EMBREE
    std::cout << "Embree is not installed: hits are not compared with it here\n";
#endif
    const Json json = benchOf({GetParam(), "--triangles", "3k"});
    EXPECT_EQ(json["scene"], GetParam());
    EXPECT_NEAR(json["triangles"].get<double>(), 3000.0, 30.0);
    EXPECT_FALSE(json["device"].get<std::string>().empty());
    expectPositive(json["build"], "seconds");
    expectPositive(json["build"], "mtris_per_second");
    expectPositive(json["build"], "bytes_per_triangle");
    expectPositive(json["build"], "depth");
    Words kinds;
    for (const Json& rays : json["rays"]) {
        kinds.push_back(rays["kind"]);
        expectKind(rays);
    }
    EXPECT_EQ(kinds, (Words{"primary", "shadow", "bounce1", "bounce2", "glossy"}));
    EXPECT_EQ(json["rays"][0]["count"], 48 * 27);
    EXPECT_EQ(json["embree"].is_string(), LICHT_HAS_EMBREE == 1);
}

INSTANTIATE_TEST_SUITE_P(Scenes, BenchScene, testing::Values("terrain", "spheres"),
                         [](const auto& scene) { return scene.param; });

TEST(Bench, AnEmptySceneHasPrimaryRaysAlone) {
    const Json json = benchOf({"empty"});
    EXPECT_EQ(json["triangles"], 0);
    EXPECT_EQ(json["rays"][0]["count"], 48 * 27);
    for (std::size_t i = 1; i < 5; ++i) {
        EXPECT_EQ(json["rays"][i]["count"], 0);
        EXPECT_TRUE(json["rays"][i]["mrays_per_second"].is_null());
    }
}

TEST(Bench, NamesThatAreNoTextAreWrittenAsText) {
    const ScratchFolder folder;
    folder.write("a\xff.gltf", R"({"asset": {"version": "2.0"}})");
    const Outcome outcome =
        runLicht(folder, {"bench", "a\xff.gltf", "--size", "8x8", "--runs", "1", "--json", "out.json"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(Json::parse(folder.read("out.json"))["scene"], "a\xef\xbf\xbd.gltf");
}

struct Refused {
    const char* name;
    Words arguments;
    const char* says;
};

void PrintTo(const Refused& refused, std::ostream* stream) {
    *stream << testing::PrintToString(refused.arguments);
}

class BenchRefuses : public testing::TestWithParam<Refused> {};

TEST_P(BenchRefuses, InOneLineAndLeavesNothing) {
    const ScratchFolder folder;
    const Outcome outcome = runLicht(folder, GetParam().arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    ASSERT_EQ(outcome.errorLines().size(), 1U) << outcome.err;
    EXPECT_NE(outcome.err.find(GetParam().says), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(folder.contents().empty());
}

const Refused kRefused[] = {
    {"NoTriangles", {"bench", "--triangles", "0"}, "--triangles '0'"},
    {"FewerThanNone", {"bench", "--triangles", "-1"}, "--triangles '-1'"},
    {"NoNumber", {"bench", "--triangles", "many"}, "--triangles 'many'"},
    {"UnitAlone", {"bench", "--triangles", "k"}, "--triangles 'k'"},
    {"TooMany", {"bench", "--triangles", "1e12"}, "--triangles '1e12'"},
    {"NotANumber", {"bench", "--triangles", "nanM"}, "--triangles 'nanM'"},
    {"Infinite", {"render", "terrain", "--triangles", "inf"}, "--triangles 'inf'"},
    {"OtherUnit", {"render", "terrain", "--triangles", "3G"}, "--triangles '3G'"},
    {"SceneOfItsOwn", {"bench", "cornell", "--triangles", "3k"}, "cornell"},
    {"File", {"render", "x.glb", "--triangles", "3k"}, "x.glb"},
    {"UnknownScene", {"bench", "mountain"}, "mountain"},
    {"NoRuns", {"bench", "--runs", "0"}, "--runs '0'"},
    {"NoQuality", {"bench", "--quality", "worst"}, "--quality 'worst'"},
    {"NoFolder", {"bench", "--json", "missing/out.json"}, "missing/out.json"},
    {"UnknownDevice", {"bench", "--triangles", "1k", "--device", "abacus"}, "abacus"},
    {"TooManyPixels",
     {"bench", "--triangles", "1k", "--size", "16384x8192", "--json", "out.json"},
     "16384x8192"},
};

INSTANTIATE_TEST_SUITE_P(Cases, BenchRefuses, testing::ValuesIn(kRefused),
                         [](const auto& refused) { return refused.param.name; });

TEST(Bench, HelpNamesItsOptions) {
    const ScratchFolder folder;
    const Outcome outcome = runLicht(folder, {"bench", "--help"});
    EXPECT_EQ(outcome.exit_code, 0);
    for (const char* word :
         {"--triangles", "--json", "--size", "--runs", "--quality", "--device", "terrain", "spheres"})
        EXPECT_NE(outcome.out.find(word), std::string::npos) << word;
}

}  // namespace
}  // namespace licht::test
