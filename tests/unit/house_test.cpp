// The rules of the house that a compiler does not keep: small files, small functions, includes named as
// folders are.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace licht {
namespace {

namespace fs = std::filesystem;

fs::path root() {
    return LICHT_SOURCE;
}

std::vector<std::string> linesOf(const fs::path& path) {
    std::ifstream stream(path);
    EXPECT_TRUE(stream) << path;
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

/// Every source file that is no test.
std::vector<fs::path> productionFiles() {
    const std::set<std::string> endings{".h", ".cpp", ".glsl", ".comp", ".vert", ".frag", ".cmake", ".txt"};
    std::vector<fs::path> files;
    for (const char* folder : {"engine", "shaders", "samples", "cmake"}) {
        for (const auto& entry : fs::recursive_directory_iterator(root() / folder))
            if (entry.is_regular_file() && endings.contains(entry.path().extension().string()))
                files.push_back(entry.path());
    }
    return files;
}

TEST(House, FilesAreAtMost400Lines) {
    const std::vector<fs::path> files = productionFiles();
    ASSERT_GT(files.size(), 200U);
    for (const fs::path& file : files) EXPECT_LE(linesOf(file).size(), 400U) << file;
}

/// The longest function of a file, in lines, and its first line. The formatter begins functions in the first
/// column, or in the fifth within a class, and ends them with a brace there. (Blocks within functions begin
/// so too, and are shorter.)
std::pair<std::size_t, std::string> longestFunction(const std::vector<std::string>& lines) {
    const std::regex no_function(
        R"((namespace|class|struct|enum|union|extern|template|public|private|protected|layout|:|#|//|\}| ).*)");
    std::pair<std::size_t, std::string> longest{0, ""};
    for (const std::string indent : {"", "    "}) {
        for (std::size_t i = 0; i < lines.size(); ++i) {
            if (!lines[i].starts_with(indent) || lines[i].size() == indent.size() ||
                std::regex_match(lines[i].substr(indent.size()), no_function))
                continue;
            std::size_t body = i;
            while (body < lines.size() && !lines[body].empty() &&
                   std::string("{};").find(lines[body].back()) == std::string::npos)
                ++body;
            if (body == lines.size() || !lines[body].ends_with("{")) continue;
            std::string head;
            for (std::size_t k = i; k <= body; ++k) head += lines[k];
            if (std::count(head.begin(), head.end(), '(') != std::count(head.begin(), head.end(), ')'))
                continue;  // a lambda in a call
            std::size_t end = body;
            while (end < lines.size() && !lines[end].starts_with(indent + "}")) ++end;
            longest = std::max(longest, {end - i + 1, lines[i]});
        }
    }
    return longest;
}

TEST(House, FunctionsAreAtMost80Lines) {
    std::size_t functions = 0;
    for (const fs::path& file : productionFiles()) {
        const auto [lines, name] = longestFunction(linesOf(file));
        EXPECT_LE(lines, 80U) << file << ": " << name;
        functions += lines > 0 ? 1 : 0;
    }
    EXPECT_GT(functions, 100U);
}

/// Where a reader looks for what a file includes: licht/X is engine/X or, of what both languages read,
/// shaders/shared.
TEST(House, IncludesAreFoundWithoutABuild) {
    const std::regex include(R"rule(^#include "(licht|samples|pure|bound|shared|support)/(.*)")rule");
    std::size_t found = 0;
    for (const char* folder : {"engine", "shaders", "samples", "tests"}) {
        for (const auto& entry : fs::recursive_directory_iterator(root() / folder)) {
            if (!entry.is_regular_file()) continue;
            for (const std::string& line : linesOf(entry.path())) {
                std::smatch match;
                if (!std::regex_search(line, match, include)) continue;
                const std::string name = match[2];
                if (name.starts_with("spirv/")) continue;  // compiled shaders
                const std::string where = match[1];
                const fs::path base =
                    where == "licht" ? name.starts_with("shared/") ? root() / "shaders" : root() / "engine"
                    : where == "samples" ? root() / "samples"
                    : where == "support" ? root() / "tests" / "support"
                                         : root() / "shaders" / where;
                EXPECT_TRUE(fs::exists(base / name)) << entry.path() << ": " << line;
                ++found;
            }
        }
    }
    EXPECT_GT(found, 500U);
}

}  // namespace
}  // namespace licht
