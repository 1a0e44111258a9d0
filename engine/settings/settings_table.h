#pragma once
// Every setting once: how it is called, what it means, what it may be, how it is set from text and told as a
// value. The command line, its help, the report and the attributes of files follow from these rows.
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "licht/settings/settings.h"

namespace licht {

/// Nothing (it was not asked for), on or off, a number, or a name.
using SettingValue = std::variant<std::monostate, bool, std::uint64_t, float, double, std::string_view>;

/// What a setting is about; those of a group stand together in help.
enum class SettingGroup { look, stop, transport, material, sampling, biased, expert };
/// Heading of a group; empty: that of options in general.
std::string_view titleOf(SettingGroup group);

/// Who is told a setting, as bits.
enum SettingUse : unsigned {
    kForRun = 1U,   ///< a run that ends
    kForView = 2U,  ///< an interactive view
    kInFile = 4U    ///< the picture follows from it, so its file says it
};

struct Setting {
    std::string_view option;       ///< "--direct"
    std::string_view placeholder;  ///< for its value in help, "HOW"; empty: a flag
    SettingGroup group;
    unsigned uses;
    std::string meaning;  ///< with its names and its default
    /// Of all programs that it holds for; the scene on the device has some that are not here.
    std::optional<std::uint32_t> constant = {};
    std::string_view implied = {};  ///< what the option alone stands for, where its value may be left out

    /// From text; throws InputError that names option, text and what is allowed. A flag takes "yes" and "no".
    std::function<void(RunSettings&, std::string_view text)> set = {};
    std::function<SettingValue(const RunSettings&)> value = {};
    std::vector<std::string_view> names = {};                         ///< of a choice
    std::function<std::uint32_t(const RenderSettings&)> number = {};  ///< the constant's
};

/// What a run that ends can be told, in the order of help.
std::span<const Setting> settingsTable();
/// What an interactive view can be told.
std::span<const Setting> viewerSettingsTable();

/// Specialisation constants by their ids (shared/constants.h), of the rows that have one.
std::map<std::uint32_t, std::uint32_t> settingConstants(const RenderSettings& settings);

/// As a row takes it: "none" for nothing, "yes" and "no" for a flag.
std::string textOf(const SettingValue& value);
/// Its key in a report: "environment_sampling".
std::string reportKeyOf(const Setting& setting);
/// Its attribute in a file: "licht.environmentSampling".
std::string attributeNameOf(const Setting& setting);

}  // namespace licht
