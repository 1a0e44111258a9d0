// Words rot where nobody asks them: the paths and options that the READMEs name are there.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "licht/settings/settings_table.h"
#include "samples/licht/command_line.h"
#include "samples/scenes/builtin.h"

namespace licht {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = LICHT_ROOT;
const std::vector<std::string> kTopFolders{"cmake", "engine", "samples", "shaders", "tests"};

std::string textOf(const fs::path& file) {
    std::ifstream stream(file);
    std::ostringstream text;
    text << stream.rdbuf();
    EXPECT_FALSE(text.str().empty()) << file;
    return text.str();
}

/// What is ours: no build folder.
std::vector<fs::path> filesOfRepository() {
    std::vector<fs::path> files;
    for (const std::string& top : kTopFolders)
        for (const auto& entry : fs::recursive_directory_iterator(kRoot / top)) files.push_back(entry.path());
    return files;
}

std::vector<fs::path> readmes() {
    std::vector<fs::path> found{kRoot / "README.md"};
    for (const fs::path& file : filesOfRepository())
        if (file.extension() == ".md") found.push_back(file);
    return found;
}

/// All matches of the expression's first group.
std::vector<std::string> matchesOf(const std::string& text, const char* expression) {
    const std::regex regex(expression);
    std::vector<std::string> found;
    for (auto at = std::sregex_iterator(text.begin(), text.end(), regex); at != std::sregex_iterator(); ++at)
        found.push_back((*at)[1]);
    return found;
}

/// Words in backticks; blocks of code are not asked.
std::vector<std::string> quotedWords(const fs::path& file) {
    const std::string text = std::regex_replace(textOf(file), std::regex("```[^`]*```"), "");
    std::vector<std::string> words;
    for (const std::string& quoted : matchesOf(text, "`([^`\n]+)`")) {
        std::istringstream stream(quoted);
        for (std::string word; stream >> word;) {
            while (!word.empty() && (word.back() == ',' || word.back() == '.')) word.pop_back();
            words.push_back(word);
        }
    }
    return words;
}

bool startsInRepository(const std::string& word) {
    return std::any_of(kTopFolders.begin(), kTopFolders.end(),
                       [&word](const std::string& top) { return word.rfind(top + "/", 0) == 0; });
}

bool isSourceName(const std::string& word) {
    return std::regex_match(word, std::regex(R"([\w/]+\.(cpp|h|glsl|comp|vert|frag|sh|cmake|md))"));
}

TEST(Words, EveryPathThatIsNamedIsThere) {
    std::set<std::string> names;
    for (const fs::path& file : filesOfRepository()) names.insert(file.filename().string());
    std::size_t asked = 0;
    for (const fs::path& readme : readmes())
        for (const std::string& word : quotedWords(readme)) {
            if (word.find_first_of("*{<$") != std::string::npos || word.find("NAME") != std::string::npos ||
                word.find("KIND") != std::string::npos)
                continue;  // a pattern
            const bool is_include = word.rfind("licht/", 0) == 0 && isSourceName(word);
            if (startsInRepository(word)) {
                EXPECT_TRUE(fs::exists(kRoot / word)) << readme << " names " << word;
            } else if (is_include) {
                EXPECT_TRUE(fs::exists(kRoot / "engine" / word.substr(6)) ||
                            fs::exists(kRoot / "shaders" / word.substr(6)))
                    << readme << " names " << word;
            } else if (isSourceName(word)) {
                EXPECT_TRUE(fs::exists(readme.parent_path() / word) || names.count(word) > 0)
                    << readme << " names " << word;
            } else {
                continue;
            }
            ++asked;
        }
    EXPECT_GT(asked, 100U) << "the words are not found";
}

TEST(Words, EveryLinkLeadsSomewhere) {
    for (const fs::path& readme : readmes())
        for (const std::string& link : matchesOf(textOf(readme), R"(\]\(([^)#:]+)\))"))
            EXPECT_TRUE(fs::exists(readme.parent_path() / link)) << readme << " links to " << link;
}

TEST(Words, EveryFolderIsOnAMap) {
    const auto expectNamed = [](const fs::path& folder, const fs::path& readme) {
        const std::string text = textOf(kRoot / readme);
        for (const auto& entry : fs::directory_iterator(kRoot / folder)) {
            if (!entry.is_directory()) continue;
            const std::string name = (folder / entry.path().filename()).generic_string();
            EXPECT_NE(text.find("`" + name + "`"), std::string::npos) << readme << " lacks " << name;
        }
    };
    expectNamed("engine", "engine/README.md");
    expectNamed("shaders", "shaders/README.md");
    expectNamed("tests", "tests/README.md");
}

std::string helpOf(const std::string& subcommand) {
    const std::array<const char*, 3> arguments{"licht", subcommand.c_str(), "--help"};
    return std::get<PrintedText>(parseCommandLine(static_cast<int>(arguments.size()), arguments.data())).text;
}

TEST(Words, TheReadmeNamesEveryOptionOfRender) {
    const std::vector<std::string> words = quotedWords(kRoot / "README.md");
    const std::set<std::string> named(words.begin(), words.end());
    for (const Setting& setting : settingsTable())
        EXPECT_TRUE(named.count(std::string(setting.option)) > 0) << "README.md lacks " << setting.option;
    for (const std::string& option : matchesOf(helpOf("render"), "\n  (--[a-z-]+)"))
        EXPECT_TRUE(named.count(option) > 0) << "README.md lacks " << option;
}

TEST(Words, EveryOptionThatIsNamedIsThere) {
    std::set<std::string> known{"--help", "--install", "--prefix"};  // the last two are CMake's
    for (const char* subcommand : {"render", "view", "info", "bench", "devices", "compare", "accuracy"})
        for (const std::string& option : matchesOf(helpOf(subcommand), "(--[a-z][a-z-]+)"))
            known.insert(option);
    for (const fs::path& readme : readmes())
        for (const std::string& word : quotedWords(readme)) {
            const std::string option = word.substr(0, word.find('='));
            const bool is_option = option.rfind("--", 0) == 0 && option != "--OPTION";
            EXPECT_TRUE(!is_option || known.count(option) > 0) << readme << " names " << option;
        }
}

TEST(Words, ChoicesAndDefaultsAreThoseOfTheTable) {
    const std::string text = textOf(kRoot / "samples/licht/README.md");
    for (const Setting& setting : settingsTable()) {
        const bool has_row =
            setting.group == SettingGroup::sampling || setting.group == SettingGroup::material;
        if (!has_row || setting.names.empty()) continue;
        const std::string row = fmt::format("`{} {}`", setting.option, fmt::join(setting.names, ", "));
        EXPECT_NE(text.find(row), std::string::npos) << "no row " << row;
    }
}

TEST(Words, TheReadmeNamesEveryBuiltInScene) {
    const std::vector<std::string> words = quotedWords(kRoot / "README.md");
    for (const BuiltinScene& scene : builtinScenes())
        EXPECT_EQ(std::count(words.begin(), words.end(), scene.name) > 0, true) << scene.name;
}

}  // namespace
}  // namespace licht
