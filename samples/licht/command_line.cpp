#include "samples/licht/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <span>

#include "licht/core/error.h"
#include "licht/settings/settings_table.h"
#include "samples/licht/command_options.h"
#include "samples/licht/text.h"
#include "samples/licht/unknown_words.h"

namespace licht {
namespace {

void requireSampleIndices(const RunSettings& run, const std::optional<PathRequest>& path) {
    // Samples go on counting from frame to frame.
    const std::uint64_t frames = path ? path->frames : 1;
    const std::uint64_t samples = run.samples.value_or(kDefaultFrameSamples);
    if (frames * samples > kMostSamples - run.render.first_sample)
        throw InputError(
            fmt::format("--first-sample {} and {}--spp {}: sample indices end at {}", run.render.first_sample,
                        path ? fmt::format("--frames {} of ", frames) : "", samples, kMostSamples));
}

/// Nobody tells how wrong its picture is.
void checkWithOidn(const RunSettings& run) {
    const LayerSet& layers = run.render.layers;
    if (run.error)
        throw InputError("--error: what --denoise oidn makes has no estimated error: say --spp or --time");
    // `all` are those that there are.
    if (layers.has(LayerId::variance) && layers != allLayers())
        throw InputError("--aov variance: what --denoise oidn makes has no estimated error");
}

void checkTogether(const RenderOptions& options) {
    const auto isExr = [](const std::filesystem::path& path) {
        return lowerCase(path.extension().string()) == ".exr";
    };
    const LayerSet& layers = options.run.render.layers;
    const bool exr = std::any_of(options.outputs.begin(), options.outputs.end(), isExr);
    if (!layers.without(LayerId::bounces).empty() && !exr)
        throw InputError("--aov: layers are stored in .exr files only: add -o FILE.exr");
    if (layers.has(LayerId::bounces) && !exr && !options.report)
        throw InputError(
            "--aov bounces: the layers are stored in .exr files and summed up in the report: add -o FILE.exr "
            "or --report FILE");
    const RunSettings& run = options.run;
    if (options.unfiltered && (!filtersStills(run.render.denoise) || options.path))
        throw InputError("--unfiltered: is of a still that is filtered, as with --denoise spatiotemporal");
    if (run.render.denoise == Denoise::oidn) checkWithOidn(run);
    if (options.path && (run.seconds || run.error || run.render.adaptive))
        throw InputError(
            "--path: its frames have --spp samples each; leave out --time, --error and --adaptive");
    requireSampleIndices(run, options.path);
}

/// An option whose value may be left out takes it behind a "="; a word that can only be its value is joined.
void joinImpliedValues(std::vector<std::string>& words) {
    for (const Setting& setting : settingsTable()) {
        if (setting.implied.empty()) continue;
        for (std::size_t i = 0; i + 1 < words.size(); ++i) {
            const auto& names = setting.names;
            if (words[i] != setting.option || std::ranges::find(names, words[i + 1]) == names.end()) continue;
            words[i] += "=" + words[i + 1];
            words.erase(words.begin() + static_cast<std::ptrdiff_t>(i) + 1);
        }
    }
}

/// Of what was typed, in its order, what no option and no argument took.
std::string describeExtras(const std::vector<std::string>& words, const CLI::App& app) {
    const CLI::App& command = app.get_subcommands().empty() ? app : *app.get_subcommands().front();
    std::vector<std::string> options;
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
    std::vector<std::string> left = app.remaining(true);
    std::vector<std::string> unknown;
    for (const std::string& word : words) {
        const auto found = std::ranges::find(left, word);
        if (found == left.end()) continue;
        unknown.push_back(word);
        left.erase(found);
    }
    const std::string name = &command == &app ? "" : command.get_name() + " ";
    return fmt::format("{} (see 'licht {}--help')", describeUnknown(unknown, options), name);
}

/// What was typed, with `help [COMMAND]` and `version` for those who try them.
std::vector<std::string> commandWords(int argument_count, const char* const* arguments) {
    std::vector<std::string> words(arguments + std::min(argument_count, 1), arguments + argument_count);
    if (words.empty()) return words;
    if (words[0] == "version") words[0] = "--version";
    if (words[0] == "help") {
        words.erase(words.begin());
        words.emplace_back("--help");
    }
    return words;
}

}  // namespace

Command parseCommandLine(int argument_count, const char* const* arguments) {
    CLI::App app("Licht, a Vulkan renderer that knows how right its pictures are", "licht");
    app.set_version_flag("--version", "licht " LICHT_VERSION);
    app.set_help_flag("-h,--help", "Print this and leave");
    app.require_subcommand(0, 1);  // what is no subcommand is named by the error for what is not expected
    app.footer("Exit codes: 0 done, 1 the device or the engine failed, 2 bad input or usage.");

    RenderOptions render;
    InfoOptions info;
    DevicesOptions devices;
    ViewOptions view;
    BenchOptions bench;
    CompareOptions compare;
    AccuracyOptions accuracy;
    CLI::App* render_app = app.add_subcommand("render", "Render a scene to files");
    addRender(*render_app, render);
    CLI::App* view_app = app.add_subcommand("view", "Look at a scene in a window");
    addView(*view_app, view);
    CLI::App* info_app = app.add_subcommand("info", "Say what is in a scene and which effects it calls for");
    addInfo(*info_app, info);
    CLI::App* bench_app = app.add_subcommand("bench", "Measure how fast rays find their hits in a scene");
    addBench(*bench_app, bench);
    CLI::App* devices_app =
        app.add_subcommand("devices", "List every Vulkan device, chosen or refused with all reasons");
    addDevices(*devices_app, devices);
    CLI::App* compare_app = app.add_subcommand("compare", "Measure how far pictures are from a reference");
    addCompare(*compare_app, compare);
    CLI::App* accuracy_app =
        app.add_subcommand("accuracy", "Measure how right pictures are, and what that costs in time");
    addAccuracy(*accuracy_app, accuracy);

    for (CLI::App* command : {render_app, view_app, info_app, bench_app, compare_app, accuracy_app})
        addMemoryLimit(*command);

    std::vector<std::string> words = commandWords(argument_count, arguments);
    const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
    if (!words.empty() && !words[0].starts_with('-') &&
        std::ranges::none_of(commands, [&](const CLI::App* c) { return c->get_name() == words[0]; }))
        throw InputError(
            fmt::format("'{0}' is no command; render, view, info, bench, devices, compare, accuracy and help "
                        "are. To draw a scene: "
                        "licht render {0}",
                        words[0]));
    joinImpliedValues(words);
    try {
        app.parse(std::vector<std::string>(words.rbegin(), words.rend()));  // as CLI11 takes them
    } catch (const CLI::CallForHelp&) {
        return PrintedText{app.help()};
    } catch (const CLI::CallForVersion& call) {
        return PrintedText{std::string(call.what()) + "\n"};
    } catch (const CLI::ExtrasError&) {
        throw InputError(oneLine(describeExtras(words, app)));
    } catch (const CLI::ParseError& error) {
        throw InputError(fmt::format("{} (see 'licht --help')", oneLine(error.what())));
    }
    if (info_app->parsed()) return info;
    if (devices_app->parsed()) return devices;
    if (view_app->parsed()) return view;
    if (bench_app->parsed()) return bench;
    if (compare_app->parsed()) return compare;
    if (accuracy_app->parsed()) {
        requireSampleIndices(accuracy.run, accuracy.path);
        return accuracy;
    }
    if (!render_app->parsed())
        throw InputError(
            "a subcommand is needed: render, view, info, bench, devices, compare or accuracy (see 'licht "
            "--help')");
    checkTogether(render);
    render.run.render.orders = render.run.render.layers.has(LayerId::bounces);
    return render;
}

}  // namespace licht
