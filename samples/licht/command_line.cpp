#include "samples/licht/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <limits>
#include <span>

#include "licht/core/error.h"
#include "licht/core/memory.h"
#include "licht/settings/settings_table.h"
#include "samples/licht/text.h"
#include "samples/licht/unknown_words.h"
#include "samples/scenes/builtin.h"

namespace licht {
namespace {

/// An option of one value that `take` parses; take is given the option's name for its message.
template <typename Take>
CLI::Option* addValue(CLI::App& app, const std::string& name, const std::string& type,
                      const std::string& meaning, Take take) {
    return app
        .add_option_function<std::string>(
            name,
            [name, take](const std::string& text) { take(std::string_view(name), std::string_view(text)); },
            meaning)
        ->type_name(type);
}

std::string sceneHelp() {
    std::string help = "A .gltf or .glb file, or a built-in scene:";
    for (const BuiltinScene& scene : builtinScenes())
        help += fmt::format("\n  {}: {}", scene.name, scene.meaning);
    return help;
}

void addTriangles(CLI::App& app, SceneRequest& source, const std::string& default_count) {
    addValue(app, "--triangles", "N",
             "Triangles of a built-in scene that takes a count: 250000, 300k, 1M" + default_count,
             [&source](std::string_view option, std::string_view text) {
                 source.triangles = parseTriangles(option, text);
             });
}

void addLoading(CLI::App& app, SceneRequest& source) {
    app.add_flag("--strict", source.strict,
                 "A texture that is missing or damaged is an error (default: a warning, and magenta checks)");
}

/// Of the whole process, so it counts from where it is read.
void addMemoryLimit(CLI::App& app) {
    addValue(app, "--memory-limit", "SIZE",
             "The most memory to take, as in 500M, 8G (default: most of what is free)",
             [](std::string_view option, std::string_view text) { limitMemory(parseMemory(option, text)); });
}

void addDevice(CLI::App& app, std::string& device) {
    addValue(app, "--device", "NAME|INDEX",
             "Vulkan device, see 'licht devices' (default: the best usable one)",
             [&device](std::string_view, std::string_view text) { device = text; });
}

void addSource(CLI::App& app, SceneRequest& source) {
    app.add_option("SCENE", source.scene, sceneHelp())->required()->type_name("");
    addValue(app, "--camera", "NAME|INDEX",
             "Camera of the scene (default: its first, or one that frames everything)",
             [&source](std::string_view, std::string_view text) { source.camera = text; });
    addTriangles(app, source, "");
    addLoading(app, source);
    CLI::Option* environment =
        addValue(app, "--environment", "FILE", "Latitude-longitude sky, .hdr or .exr, in cd/m^2",
                 [&source](std::string_view, std::string_view text) { source.environment = text; });
    addValue(app, "--background", "R,G,B", "Constant sky in cd/m^2, linear Rec. 709",
             [&source](std::string_view option, std::string_view text) {
                 source.background = parseColour(option, text);
             })
        ->excludes(environment);
    addValue(app, "--environment-rotation", "DEGREES",
             "Turn the sky about +Y, counter-clockwise from above; the middle of a map is at -Z (default: 0)",
             [&source](std::string_view option, std::string_view text) {
                 source.environment_rotation = parseNumber(option, text, -kMostRotation, kMostRotation);
             });
    addValue(app, "--environment-strength", "FACTOR", "Multiply the sky's radiance (default: 1)",
             [&source](std::string_view option, std::string_view text) {
                 source.environment_strength = parsePositive(option, text);
             });
    addValue(app, "--sun-angle", "DEGREES",
             fmt::format(
                 "Angle that directional lights fill, 0 to {}; the sun's is 0.53 (default: 0, sharp shadows)",
                 kWidestSun),
             [&source](std::string_view option, std::string_view text) {
                 source.sun_angle = parseNumber(option, text, 0.0, kWidestSun);
             });
}

void addSize(CLI::App& app, std::optional<SizeRequest>& size, const std::string& default_size) {
    addValue(app, "--size", "WxH",
             "Width and height in pixels; W or xH alone: the other side by the camera (default: " +
                 default_size + ")",
             [&size](std::string_view option, std::string_view text) { size = parseSize(option, text); });
}

/// One of the table, which has its name, help and parser.
CLI::Option* addSetting(CLI::App& app, const Setting& setting, RunSettings& run) {
    const std::string option(setting.option);
    const auto take = [&setting, &run](const std::string& text) { setting.set(run, text); };
    if (!setting.placeholder.empty())
        return app.add_option_function<std::string>(option, take, setting.meaning)
            ->type_name(std::string(setting.placeholder));
    // A flag, so that a value stands behind a "=" and a scene may follow it.
    if (!setting.implied.empty())
        return app.add_flag(fmt::format("{}{{{}}}", option, setting.implied), setting.meaning)->each(take);
    return app.add_flag_callback(
        option, [take] { take("yes"); }, setting.meaning);
}

void addSettings(CLI::App& app, std::span<const Setting> table, SettingGroup group, RunSettings& run) {
    const std::string title(titleOf(group));
    for (const Setting& setting : table) {
        if (setting.group != group) continue;
        CLI::Option* added = addSetting(app, setting, run);
        if (!title.empty()) added->group(title);
    }
}

void addRender(CLI::App& app, RenderOptions& options) {
    addSource(app, options.source);
    app.add_option_function<std::vector<std::string>>(
           "-o,--output",
           [&options](const std::vector<std::string>& texts) {
               for (const std::string& text : texts) options.outputs.push_back(parseOutput("-o", text));
           },
           "Where the picture goes, .png or .exr; may be repeated (default: <scene name>.png)")
        ->allow_extra_args(false)
        ->type_name("FILE");
    const std::span<const Setting> table = settingsTable();
    addSize(app, options.size, "x540, 16:9 if the camera does not say");
    addSettings(app, table, SettingGroup::look, options.run);
    addDevice(app, options.device);
    addSettings(app, table, SettingGroup::stop, options.run);
    addSettings(app, table, SettingGroup::transport, options.run);
    addValue(app, "--aov", "LIST", "Layers for .exr outputs: all, or from " + layerNames(),
             [&options](std::string_view option, std::string_view text) {
                 options.run.render.layers = parseLayers(option, text);
             });
    addValue(app, "--report", "FILE", "Write what was done and what it cost as JSON",
             [&options](std::string_view, std::string_view text) { options.report = text; });
    app.add_flag("--quiet", options.quiet, "Say nothing but errors");
    for (const SettingGroup group :
         {SettingGroup::material, SettingGroup::sampling, SettingGroup::biased, SettingGroup::expert})
        addSettings(app, table, group, options.run);
}

void addView(CLI::App& app, ViewOptions& options) {
    addSource(app, options.source);
    const std::span<const Setting> table = viewerSettingsTable();
    addSize(app, options.size, "as for render");
    addSettings(app, table, SettingGroup::look, options.run);
    addDevice(app, options.device);
    addSettings(app, table, SettingGroup::transport, options.run);
    addSettings(app, table, SettingGroup::material, options.run);
    addSettings(app, table, SettingGroup::biased, options.run);
    addValue(app, "--frames", "N", "Close after N frames (default: when the window is closed)",
             [&options](std::string_view option, std::string_view text) {
                 options.frames = parseCount(option, text, 1, std::numeric_limits<std::uint64_t>::max());
             });
    app.footer(
        "Left drag: orbit. Right or middle drag: pan. Wheel: dolly. W A S D: move. R: reset. + -: exposure. "
        "T: next tone map. Esc: quit.\n"
        "The picture becomes cleaner while nothing moves.");
}

void addBench(CLI::App& app, BenchOptions& options) {
    options.source.scene = "terrain";
    app.add_option("SCENE", options.source.scene, sceneHelp() + "\n(default: terrain)")->type_name("");
    addTriangles(app, options.source, fmt::format(" (default: {})", kDefaultBenchTriangles));
    addLoading(app, options.source);
    addValue(app, "--camera", "NAME|INDEX", "Camera of the scene, as for render",
             [&options](std::string_view, std::string_view text) { options.source.camera = text; });
    addValue(app, "--size", "WxH", "Pixels, one path each (default: as for render)",
             [&options](std::string_view option, std::string_view text) {
                 options.size = parseSize(option, text);
             });
    addValue(app, "--runs", "N",
             fmt::format("Timed runs, whose median counts (default: {})", kDefaultBenchRuns),
             [&options](std::string_view option, std::string_view text) {
                 options.runs = parseCount32(option, text, 1, 1000);
             });
    addValue(app, "--quality", "CHOICE",
             fmt::format("How well the BVH is built: {} (default: {})", listOf<BvhQuality>(),
                         nameOf(options.quality)),
             [&options](std::string_view option, std::string_view text) {
                 options.quality = parseChoice<BvhQuality>(option, text);
             });
    addValue(app, "--json", "FILE", "Write all numbers as JSON",
             [&options](std::string_view, std::string_view text) { options.json = text; });
    addDevice(app, options.device);
    app.add_flag("--quiet", options.quiet, "Show no progress");
    app.footer(
        "Rays: primary (what the rasteriser stands for), shadow, bounce1 and bounce2 (leaving the first and "
        "second\n"
        "vertex diffusely) and glossy (leaving the first by a GGX lobe), as the path tracer makes them, in "
        "its order.\n"
        "Where Embree is installed the same rays go through it on all cores, turn by turn with the device.");
}

void addCompare(CLI::App& app, CompareOptions& options) {
    app.add_option("REFERENCE", options.reference, "The .exr file that is taken for the truth")
        ->required()
        ->type_name("");
    app.add_option("PICTURE", options.pictures, "The .exr files to compare with it")
        ->required()
        ->type_name("");
    addValue(app, "--json", "FILE", "Write all numbers as JSON",
             [&options](std::string_view, std::string_view text) { options.json = text; });
    app.footer(
        "relMSE: mean over pixels and channels of (a-b)^2 / (b^2 + 0.01 m^2); a picture, b reference, m its "
        "mean.\n"
        "R/R, G/G, B/B: the picture's mean over the reference's.\n"
        "Where both files have the layer variance, a z-test compares blocks of 16x16 pixels (block p: the "
        "smallest)\n"
        "and the whole (whole p); 'differs' marks a picture for which one is too small for chance.");
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
    if (run.samples && *run.samples > kMostSamples - run.render.first_sample)
        throw InputError(fmt::format("--first-sample {} and --spp {}: sample indices end at {}",
                                     run.render.first_sample, *run.samples, kMostSamples));
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
    CLI::App* render_app = app.add_subcommand("render", "Render a scene to files");
    addRender(*render_app, render);
    CLI::App* view_app = app.add_subcommand("view", "Look at a scene in a window");
    addView(*view_app, view);
    CLI::App* info_app = app.add_subcommand("info", "Say what is in a scene and which effects it calls for");
    info_app->add_option("SCENE", info.source.scene, sceneHelp())->required()->type_name("");
    addLoading(*info_app, info.source);
    info_app->add_flag("--json", info.json, "As JSON");
    CLI::App* bench_app = app.add_subcommand("bench", "Measure how fast rays find their hits in a scene");
    addBench(*bench_app, bench);
    CLI::App* devices_app =
        app.add_subcommand("devices", "List every Vulkan device, chosen or refused with all reasons");
    devices_app->add_flag("--json", devices.json, "As JSON");
    CLI::App* compare_app = app.add_subcommand("compare", "Measure how far pictures are from a reference");
    addCompare(*compare_app, compare);

    for (CLI::App* command : {render_app, view_app, info_app, bench_app, compare_app})
        addMemoryLimit(*command);

    std::vector<std::string> words = commandWords(argument_count, arguments);
    const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
    if (!words.empty() && !words[0].starts_with('-') &&
        std::ranges::none_of(commands, [&](const CLI::App* c) { return c->get_name() == words[0]; }))
        throw InputError(fmt::format(
            "'{0}' is no command; render, view, info, bench, devices, compare and help are. To draw a scene: "
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
    if (!render_app->parsed())
        throw InputError(
            "a subcommand is needed: render, view, info, bench, devices or compare (see 'licht --help')");
    checkTogether(render);
    render.run.render.orders = render.run.render.layers.has(LayerId::bounces);
    return render;
}

}  // namespace licht
