// What follows from the table of settings has every row: help, the command line, report, files, programs.
#include "licht/settings/settings_table.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "licht/core/error.h"
#include "licht/shared/choices.h"
#include "licht/shared/constants.h"
#include "samples/licht/command_line.h"
#include "samples/licht/report.h"

namespace licht {
namespace {

using nlohmann::json;

Command parse(std::vector<std::string> words) {
    words.insert(words.begin(), "licht");
    std::vector<const char*> arguments;
    for (const std::string& word : words) arguments.push_back(word.c_str());
    return parseCommandLine(static_cast<int>(arguments.size()), arguments.data());
}

std::string helpOf(const std::string& subcommand) {
    return std::get<PrintedText>(parse({subcommand, "--help"})).text;
}

bool isFlag(const Setting& setting) {
    return setting.placeholder.empty() && setting.implied.empty();
}

/// Texts that a setting takes and that are not its default.
std::vector<std::string> otherTexts(const Setting& setting) {
    const SettingValue by_default = setting.value(RunSettings{});
    if (isFlag(setting)) return {"yes"};
    std::vector<std::string> texts;
    for (const std::string_view name : setting.names)
        if (SettingValue(name) != by_default) texts.emplace_back(name);
    if (texts.empty()) texts.emplace_back("5");
    if (setting.option == "--bounces" && (setting.uses & kForRun) != 0) texts.emplace_back("auto");
    return texts;
}

/// As words of the command line.
std::vector<std::string> wordsFor(const Setting& setting, const std::string& text) {
    const std::string option(setting.option);
    if (isFlag(setting)) return {option};
    if (!setting.implied.empty()) return {option + "=" + text};
    return {option, text};
}

/// The values of all rows but one.
std::vector<std::string> othersThan(const Setting& row, const RunSettings& run) {
    std::vector<std::string> texts;
    for (const Setting& setting : settingsTable())
        if (setting.option != row.option) texts.push_back(textOf(setting.value(run)));
    return texts;
}

TEST(SettingsTable, OptionsAreDifferent) {
    for (const std::span<const Setting> table : {settingsTable(), viewerSettingsTable()}) {
        std::set<std::string_view> options;
        for (const Setting& setting : table)
            EXPECT_TRUE(options.insert(setting.option).second) << setting.option;
        EXPECT_FALSE(options.empty());
    }
}

TEST(SettingsTable, EveryRowIsInTheHelp) {
    const std::string render = helpOf("render");
    for (const Setting& setting : settingsTable()) {
        EXPECT_NE(render.find("\n  " + std::string(setting.option)), std::string::npos) << setting.option;
        EXPECT_NE(render.find(setting.meaning), std::string::npos) << setting.option;
        EXPECT_NE(render.find(std::string(titleOf(setting.group))), std::string::npos) << setting.option;
    }
    const std::string view = helpOf("view");
    for (const Setting& setting : viewerSettingsTable()) {
        EXPECT_NE(view.find("\n  " + std::string(setting.option)), std::string::npos) << setting.option;
        EXPECT_NE(view.find(setting.meaning), std::string::npos) << setting.option;
    }
}

TEST(SettingsTable, HelpSaysDefaultsAndNames) {
    for (const std::span<const Setting> table : {settingsTable(), viewerSettingsTable()})
        for (const Setting& setting : table) {
            const SettingValue by_default = setting.value(RunSettings{});
            if (!isFlag(setting) && !std::holds_alternative<std::monostate>(by_default)) {
                EXPECT_NE(setting.meaning.find("(default: " + textOf(by_default) + ")"), std::string::npos)
                    << setting.option << ": " << setting.meaning;
            }
            for (const std::string_view name : setting.names)
                EXPECT_NE(setting.meaning.find(name), std::string::npos) << setting.option << " " << name;
        }
}

TEST(SettingsTable, EveryRowIsAppliedAndNothingElse) {
    const RunSettings defaults;
    for (const Setting& setting : settingsTable())
        for (const std::string& text : otherTexts(setting)) {
            std::vector<std::string> words{"render", "empty"};
            const std::vector<std::string> option = wordsFor(setting, text);
            words.insert(words.end(), option.begin(), option.end());
            const RunSettings run = std::get<RenderOptions>(parse(words)).run;
            EXPECT_EQ(textOf(setting.value(run)), text) << setting.option;
            EXPECT_EQ(othersThan(setting, run), othersThan(setting, defaults)) << setting.option;
        }
}

TEST(SettingsTable, TheViewerAppliesItsRows) {
    for (const Setting& setting : viewerSettingsTable())
        for (const std::string& text : otherTexts(setting)) {
            std::vector<std::string> words{"view", "empty"};
            const std::vector<std::string> option = wordsFor(setting, text);
            words.insert(words.end(), option.begin(), option.end());
            EXPECT_EQ(textOf(setting.value(std::get<ViewOptions>(parse(words)).run)), text) << setting.option;
        }
}

TEST(SettingsTable, TextsComeBack) {
    for (const Setting& setting : settingsTable()) {
        RunSettings run;
        for (const std::string_view name : setting.names) {
            setting.set(run, name);
            EXPECT_EQ(textOf(setting.value(run)), name) << setting.option;
        }
        for (const std::string& text : otherTexts(setting)) {
            setting.set(run, text);
            EXPECT_EQ(textOf(setting.value(run)), text) << setting.option;
        }
        if (isFlag(setting)) {
            setting.set(run, "no");
            EXPECT_EQ(setting.value(run), setting.value(RunSettings{})) << setting.option;
        }
    }
}

TEST(SettingsTable, RefusalsNameOptionAndText) {
    for (const Setting& setting : settingsTable())
        for (const char* bad : {"", "nonsense", "-65", "nan", "inf", "1e999", "5 "}) {
            RunSettings run;
            try {
                setting.set(run, bad);
                ADD_FAILURE() << setting.option << " took '" << bad << "'";
            } catch (const InputError& error) {
                const std::string start = std::string(setting.option) + " '" + bad + "': must be ";
                EXPECT_EQ(std::string(error.what()).rfind(start, 0), 0U) << error.what();
            }
        }
}

TEST(SettingsTable, EveryRowIsReportedAsItWasAsked) {
    const json by_default = json::parse(reportJson(RenderReport{})).at("settings");
    EXPECT_EQ(by_default.size(), settingsTable().size());
    for (const Setting& setting : settingsTable()) {
        const std::string key = reportKeyOf(setting);
        EXPECT_EQ(by_default.at(key).is_null(),
                  std::holds_alternative<std::monostate>(setting.value(RunSettings{})))
            << key;
        for (const std::string& text : otherTexts(setting)) {
            RenderReport report;
            setting.set(report.asked, text);
            const json told = json::parse(reportJson(report)).at("settings").at(key);
            EXPECT_NE(told, by_default.at(key)) << key;
            EXPECT_EQ(told.is_boolean(), isFlag(setting)) << key;
            EXPECT_TRUE(!told.is_string() || told == text) << key << " " << told;
            EXPECT_TRUE(!told.is_number() || told == std::stod(text)) << key << " " << told;
        }
    }
}

TEST(SettingsTable, FilesSayWhatThePictureFollowsFrom) {
    for (const Setting& setting : settingsTable()) {
        const std::string name = attributeNameOf(setting);
        const std::string text = otherTexts(setting).front();
        RunSettings run;
        setting.set(run, text);
        RenderReport report;
        report.asked = run;
        report.settings = run.render;
        std::vector<std::string> told;
        for (const auto& [key, value] : reportAttributes(report))
            if (key == name) told.push_back(value);
        // The samples and the error of a picture are told as they came out.
        if (setting.group == SettingGroup::stop) continue;
        const bool is_told = (setting.uses & kInFile) != 0;
        EXPECT_EQ(told, is_told ? std::vector{text} : std::vector<std::string>{}) << name;
    }
}

TEST(SettingsTable, ADepthThatWasChosenIsTold) {
    RenderReport report;
    report.asked.auto_bounces = true;
    report.settings.bounces = 17;
    const json told = json::parse(reportJson(report));
    EXPECT_EQ(told.at("settings").at("bounces"), "auto");
    EXPECT_EQ(told.at("bounces"), 17);
    const auto attributes = reportAttributes(report);
    EXPECT_EQ(std::count(attributes.begin(), attributes.end(),
                         std::pair<std::string, std::string>("licht.bounces", "17")),
              1);
}

TEST(SettingsTable, NamesOfKeysAndAttributes) {
    for (const Setting& setting : settingsTable())
        if (setting.option == "--environment-sampling") {
            EXPECT_EQ(reportKeyOf(setting), "environment_sampling");
            EXPECT_EQ(attributeNameOf(setting), "licht.environmentSampling");
            return;
        }
    FAIL() << "no such row";
}

TEST(SettingsTable, ProgramsGetTheirConstants) {
    EXPECT_EQ(settingConstants({}),
              (std::map<std::uint32_t, std::uint32_t>{{kConstantDirect, kDirectMis},
                                                      {kConstantMisBalance, 0},
                                                      {kConstantSampler, kSamplerSobol},
                                                      {kConstantAdaptive, 0},
                                                      {kConstantClamp, 0},
                                                      {kConstantRegularise, 0},
                                                      {kConstantLayering, kLayeringView},
                                                      {kConstantEnergy, kEnergyMultiple}}));
    RenderSettings settings;
    settings.direct = DirectLight::area;
    settings.mis = MisHeuristic::balance;
    settings.sampler = Sequence::random;
    settings.adaptive = true;
    settings.clamp = 0.5F;
    settings.regularise = true;
    settings.layering = Layering::gltf;
    settings.energy = Energy::single;
    EXPECT_EQ(settingConstants(settings),
              (std::map<std::uint32_t, std::uint32_t>{{kConstantDirect, kDirectArea},
                                                      {kConstantMisBalance, 1},
                                                      {kConstantSampler, kSamplerRandom},
                                                      {kConstantAdaptive, 1},
                                                      {kConstantClamp, 1},
                                                      {kConstantRegularise, 1},
                                                      {kConstantLayering, kLayeringGltf},
                                                      {kConstantEnergy, kEnergySingle}}));
}

}  // namespace
}  // namespace licht
