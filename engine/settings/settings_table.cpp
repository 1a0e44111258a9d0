#include "licht/settings/settings_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <type_traits>

#include "licht/core/error.h"
#include "licht/settings/parse.h"
#include "licht/shared/constants.h"

namespace licht {
namespace {

// A field of either struct, by its pointer.
template <typename Run, typename T>
auto& fieldOf(Run& run, T RenderSettings::*field) {
    return run.render.*field;
}
template <typename Run, typename T>
auto& fieldOf(Run& run, T RunSettings::*field) {
    return run.*field;
}

template <typename T>
SettingValue tell(const T& value) {
    if constexpr (std::is_enum_v<T>)
        return nameOf(value);
    else if constexpr (std::is_same_v<T, std::uint32_t>)
        return std::uint64_t{value};
    else
        return value;
}
template <typename T>
SettingValue tell(const std::optional<T>& value) {
    return value ? tell(*value) : SettingValue{};
}

/// Completes a row: its meaning may hold {default}, which is put behind it otherwise, and {values}.
template <typename Value>
Setting complete(Setting row, Value value, const std::string& values = {}) {
    row.value = value;
    const SettingValue by_default = row.value(RunSettings{});
    const bool is_said = row.meaning.find("{default}") != std::string::npos;
    const bool is_flag = std::holds_alternative<bool>(by_default);
    if (!is_said && !is_flag && !std::holds_alternative<std::monostate>(by_default))
        row.meaning += " (default: {default})";
    row.meaning = fmt::format(fmt::runtime(row.meaning), fmt::arg("values", values),
                              fmt::arg("default", textOf(by_default)));
    return row;
}

template <typename Field, typename Parse>
Setting parsed(Setting row, Field field, Parse parse, const std::string& values = {}) {
    row.set = [option = row.option, field, parse](RunSettings& run, std::string_view text) {
        fieldOf(run, field) = parse(option, text);
    };
    return complete(
        std::move(row), [field](const RunSettings& run) { return tell(fieldOf(run, field)); }, values);
}

Setting flag(Setting row, bool RenderSettings::*field) {
    row.number = [field](const RenderSettings& settings) { return settings.*field ? 1U : 0U; };
    return parsed(std::move(row), field, [](std::string_view option, std::string_view text) {
        if (text != "yes" && text != "no") refuseValue(option, text, "yes or no");
        return text == "yes";
    });
}

template <typename Field>
Setting count(Setting row, Field field, std::uint32_t lowest, std::uint32_t highest) {
    return parsed(std::move(row), field, [lowest, highest](std::string_view option, std::string_view text) {
        return parseCount32(option, text, lowest, highest);
    });
}

template <typename Choice, typename Settings>
Setting choice(Setting row, Choice Settings::*field,
               std::span<const NamedChoice<Choice>> choices = choicesOf<Choice>()) {
    for (const auto& known : choices) row.names.push_back(known.name);
    if constexpr (std::is_same_v<Settings, RenderSettings>)
        row.number = [field](const RenderSettings& settings) {
            return static_cast<std::uint32_t>(settings.*field);
        };
    return parsed(
        std::move(row), field,
        [choices](std::string_view option, std::string_view text) {
            return parseChoice<Choice>(option, text, choices);
        },
        listOf<Choice>(choices));
}

/// What the renderer itself does about noise.
std::span<const NamedChoice<Denoise>> ownDenoisers() {
    constexpr std::size_t kOwn = namesOf(Denoise{}).size() - 1;
    static_assert(namesOf(Denoise{})[kOwn].choice == Denoise::oidn);
    return choicesOf<Denoise>().first(kOwn);
}

/// That, and the library that works on a picture when its samples are there.
Setting denoiseOfRun(const Setting& row) {
    if (offersOidn()) return choice(row, &RenderSettings::denoise);
    Setting own = choice(row, &RenderSettings::denoise, ownDenoisers());
    own.set = [option = row.option, set = own.set](RunSettings& run, std::string_view text) {
        if (text == nameOf(Denoise::oidn))
            throw InputError(fmt::format("{} '{}': this build has no OpenImageDenoise", option, text));
        set(run, text);
    };
    return own;
}

/// A number of bounces, or "auto".
Setting automaticBounces(Setting row) {
    row.set = [option = row.option](RunSettings& run, std::string_view text) {
        run.auto_bounces = text == "auto";
        if (!run.auto_bounces) run.render.bounces = parseCount32(option, text, 0, kMostBounces);
    };
    return complete(std::move(row), [](const RunSettings& run) {
        return run.auto_bounces ? SettingValue(std::string_view("auto")) : tell(run.render.bounces);
    });
}

/// A limit, of which zero stands for none; its constant says whether there is one.
Setting limit(Setting row, float RenderSettings::*field) {
    row.number = [field](const RenderSettings& settings) { return settings.*field > 0.0F ? 1U : 0U; };
    row.set = [option = row.option, field](RunSettings& run, std::string_view text) {
        run.render.*field = parsePositiveFloat(option, text);
    };
    return complete(std::move(row), [field](const RunSettings& run) {
        const float value = run.render.*field;
        return value > 0.0F ? SettingValue(value) : SettingValue{};
    });
}

constexpr std::uint32_t kMaxCount32 = std::numeric_limits<std::uint32_t>::max();
constexpr std::string_view kFlag = {};
constexpr const char* kBouncesMeaning =
    "0: emission alone, 1: and direct light, and so on (default: {default})";
constexpr const char* kDenoiseMeaning =
    "Filter the picture by {values}; its error estimate is that of the filtered picture";

// Columns: option, placeholder, group, uses, meaning and, where there is one, the constant; then what of the
// settings it is, and its range.
std::vector<Setting> generalRows() {
    using enum SettingGroup;
    const auto exposure = [](std::string_view option, std::string_view text) {
        return parseNumber(option, text, -kMostExposure, kMostExposure);
    };
    return {parsed({"--exposure", "EV", look, kForRun | kForView,
                    "Display exposure in stops: values are multiplied by 2^EV (default: the scene's)"},
                   &RunSettings::exposure, exposure),
            choice({"--tonemap", "CURVE", look, kForRun | kForView, "Display curve: {values}"},
                   &RunSettings::tonemap),
            count({"--spp", "N", stop, kForRun,
                   fmt::format("Samples per pixel (default: {} unless --time, --error or --path is given)",
                               kDefaultSamples)},
                  &RunSettings::samples, 1, kMostSamples),
            parsed({"--time", "SECONDS", stop, kForRun, "Stop after that many seconds of rendering"},
                   &RunSettings::seconds, parsePositive),
            parsed({"--error", "REL", stop, kForRun,
                    "Stop at that estimated relative error (square root of relMSE); 0.01 is a clean picture"},
                   &RunSettings::error, parsePositive),
            automaticBounces(
                {"--bounces", "N|auto", transport, kForRun | kInFile,
                 kBouncesMeaning + fmt::format("; auto: by a small pilot, until what is missing is less than "
                                               "--error (default: {}) of the light, at most {}",
                                               kDefaultTailShare, kMostAutoBounces)}),
            count({"--bounces", "N", transport, kForView, kBouncesMeaning}, &RenderSettings::bounces, 0,
                  kMostBounces),
            count({"--seed", "N", transport, kForRun | kForView | kInFile,
                   "Same seed, same picture, bit for bit"},
                  &RenderSettings::seed, 0, kMaxCount32)};
}

std::vector<Setting> materialRows() {
    using enum SettingGroup;
    constexpr unsigned kUses = kForRun | kForView | kInFile;
    return {choice({"--layering", "HOW", material, kUses,
                    "What a dielectric's specular layer leaves to the diffuse one: by {values}",
                    kConstantLayering},
                   &RenderSettings::layering),
            choice({"--energy", "HOW", material, kUses,
                    "Light that goes from microfacet to microfacet: {values} scattering", kConstantEnergy},
                   &RenderSettings::energy)};
}

std::vector<Setting> samplingRows() {
    using enum SettingGroup;
    constexpr unsigned kUses = kForRun | kInFile;
    return {
        choice({"--direct", "HOW", sampling, kUses, "Direct light by {values}", kConstantDirect},
               &RenderSettings::direct),
        choice({"--mis", "HOW", sampling, kUses, "Weights of mis: {values} heuristic", kConstantMisBalance},
               &RenderSettings::mis),
        choice({"--lights", "HOW", sampling, kUses, "Pick one of many lights by {values}"},
               &RenderSettings::lights),
        choice({"--environment-sampling", "HOW", sampling, kUses,
                "Draw a direction to the environment by {values}"},
               &RenderSettings::environment_sampling),
        choice({"--sampler", "HOW", sampling, kUses, "Samples from {values}", kConstantSampler},
               &RenderSettings::sampler),
        flag({"--adaptive", kFlag, sampling, kUses,
              "Draw more samples where the noise is; --spp is then the mean over the pixels",
              kConstantAdaptive},
             &RenderSettings::adaptive),
        limit(
            {"--clamp", "LIMIT", biased, kUses,
             "Cut what one path finds after two or more scatterings down to this, in cd/m^2", kConstantClamp},
            &RenderSettings::clamp),
        flag({"--regularise", kFlag, biased, kUses, "Widen glossy lobes behind a path's first scattering",
              kConstantRegularise},
             &RenderSettings::regularise),
        denoiseOfRun({"--denoise", "HOW", biased, kForRun | kInFile, kDenoiseMeaning}),
        choice({"--denoise", "HOW", biased, kForView, kDenoiseMeaning}, &RenderSettings::denoise,
               ownDenoisers())};
}

std::vector<Setting> expertRows() {
    using enum SettingGroup;
    return {count({"--roulette", "BOUNCE", expert, kForRun | kInFile,
                   "First bounce that may end a path by chance, keeping the mean"},
                  &RenderSettings::roulette_start, 0, kMaxCount32),
            count({"--first-sample", "N", expert, kForRun | kInFile,
                   "Index of the first sample: ranges rendered apart merge to the whole"},
                  &RenderSettings::first_sample, 0, kMostSamples - 1),
            flag({"--all-effects", kFlag, expert, kForRun,
                  "Compile every effect, whether the scene calls for it or not"},
                 &RenderSettings::all_effects),
            choice({"--bvh", "QUALITY", expert, kForRun,
                    "How well the BVH is built: {values}; better trees take longer to build"},
                   &RenderSettings::bvh_quality),
            choice({"--queues", kFlag, expert, kForRun,
                    "Follow paths by small kernels with queues between them instead of one kernel, the same "
                    "samples: --queues={values}",
                    std::nullopt, nameOf(QueueUse::on)},
                   &RunSettings::queues),
            flag({"--flatten-instances", kFlag, expert, kForRun,
                  "Store every instance of a mesh as triangles of its own"},
                 &RenderSettings::flatten_instances)};
}

std::vector<Setting> rowsFor(SettingUse use) {
    std::vector<Setting> rows;
    for (std::vector<Setting>& part : std::array{generalRows(), materialRows(), samplingRows(), expertRows()})
        for (Setting& row : part)
            if ((row.uses & use) != 0) rows.push_back(std::move(row));
    return rows;
}

struct TextOfValue {
    std::string operator()(std::monostate) const { return "none"; }
    std::string operator()(bool on) const { return on ? "yes" : "no"; }
    template <typename T>
    std::string operator()(const T& value) const {
        return fmt::format("{}", value);
    }
};

}  // namespace

std::span<const Setting> settingsTable() {
    static const std::vector<Setting> rows = rowsFor(kForRun);
    return rows;
}

std::span<const Setting> viewerSettingsTable() {
    static const std::vector<Setting> rows = rowsFor(kForView);
    return rows;
}

std::string_view titleOf(SettingGroup group) {
    switch (group) {
        case SettingGroup::look:
        case SettingGroup::stop:
        case SettingGroup::transport:
            return {};
        case SettingGroup::material:
            return "Materials (other light)";
        case SettingGroup::sampling:
            return "Sampling (same mean, other noise)";
        case SettingGroup::biased:
            return "Biased shortcuts (the report says what they take)";
        case SettingGroup::expert:
            return "Expert options";
    }
    return {};
}

std::map<std::uint32_t, std::uint32_t> settingConstants(const RenderSettings& settings) {
    std::map<std::uint32_t, std::uint32_t> constants;
    for (const Setting& setting : settingsTable())
        if (setting.constant) constants[*setting.constant] = setting.number(settings);
    return constants;
}

std::string textOf(const SettingValue& value) {
    return std::visit(TextOfValue{}, value);
}

std::string reportKeyOf(const Setting& setting) {
    std::string key(setting.option.substr(2));
    std::replace(key.begin(), key.end(), '-', '_');
    return key;
}

std::string attributeNameOf(const Setting& setting) {
    std::string name = "licht.";
    bool raise = false;
    for (const char c : setting.option.substr(2)) {
        if (c != '-') name += raise ? static_cast<char>(std::toupper(c)) : c;
        raise = c == '-';
    }
    return name;
}

}  // namespace licht
