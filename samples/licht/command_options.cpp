#include "samples/licht/command_options.h"

#include <fmt/format.h>

#include <functional>
#include <limits>
#include <span>

#include "licht/core/memory.h"
#include "licht/settings/settings_table.h"
#include "samples/licht/camera_path.h"
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

/// request: what the path's options fill in.
CLI::Option* addPath(CLI::App& app, const std::string& meaning,
                     const std::function<PathRequest&()>& request) {
    std::string help = meaning + ": a .json file, or";
    for (const BuiltinPath& path : builtinPaths()) help += fmt::format("\n  {}: {}", path.name, path.meaning);
    CLI::Option* path =
        addValue(app, "--path", "NAME|FILE", help,
                 [request](std::string_view, std::string_view text) { request().path = text; });
    addValue(app, "--frames", "N", fmt::format("Of the path (default: {})", kDefaultFrames),
             [request](std::string_view option, std::string_view text) {
                 request().frames = parseCount32(option, text, 1, kMostFrames);
             });
    addValue(app, "--fps", "RATE", fmt::format("Frames a second of the path (default: {})", kDefaultRate),
             [request](std::string_view option, std::string_view text) {
                 request().rate = parseNumber(option, text, 1.0 / kMostRate, kMostRate);
             });
    return path;
}

void addSequence(CLI::App& app, RenderOptions& options) {
    CLI::Option* path =
        addPath(app,
                fmt::format("Follow a camera's path, a picture of --spp samples (default: {}) each frame",
                            kDefaultFrameSamples),
                [&options]() -> PathRequest& {
                    if (!options.path) options.path.emplace();
                    return *options.path;
                });
    for (const char* part : {"--frames", "--fps"}) app.get_option(part)->needs(path);
    app.add_flag("--resume", options.resume, "Go on behind the path's frames that are there")->needs(path);
}

}  // namespace

void addRender(CLI::App& app, RenderOptions& options) {
    addSource(app, options.source);
    app.add_option_function<std::vector<std::string>>(
           "-o,--output",
           [&options](const std::vector<std::string>& texts) {
               for (const std::string& text : texts) options.outputs.push_back(parseOutput("-o", text));
           },
           "Where the picture goes, .png or .exr; may be repeated; for a path with the frame's number, as in "
           "f-%04d.exr (default: <scene name>.png, <scene name>-%04d.png)")
        ->allow_extra_args(false)
        ->type_name("FILE");
    const std::span<const Setting> table = settingsTable();
    addSize(app, options.size, "x540, 16:9 if the camera does not say");
    addSettings(app, table, SettingGroup::look, options.run);
    addDevice(app, options.device);
    addSettings(app, table, SettingGroup::stop, options.run);
    addSequence(app, options);
    addSettings(app, table, SettingGroup::transport, options.run);
    addValue(app, "--aov", "LIST", "Layers for .exr outputs: all, or from " + layerNames(),
             [&options](std::string_view option, std::string_view text) {
                 options.run.render.layers = parseLayers(option, text);
             });
    addValue(app, "--unfiltered", "FILE", "With --denoise: write the picture before it, too, .png",
             [&options](std::string_view option, std::string_view text) {
                 options.unfiltered = parseOutput(option, text);
                 if (options.unfiltered->extension() != ".png")
                     refuseValue(option, text, "a file that ends in .png");
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

void addInfo(CLI::App& app, InfoOptions& options) {
    app.add_option("SCENE", options.source.scene, sceneHelp())->required()->type_name("");
    addLoading(app, options.source);
    app.add_flag("--json", options.json, "As JSON");
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

void addDevices(CLI::App& app, DevicesOptions& options) {
    app.add_flag("--json", options.json, "As JSON");
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
        "FLIP: how much the difference is seen, 0 to 1 (Andersson et al. 2020), from 0.7 m at 3840 pixels in "
        "0.7 m that\n"
        "show both at exposure 0 by the plain sRGB curve, clamped to [0,1].\n"
        "R/R, G/G, B/B: the picture's mean over the reference's.\n"
        "Where both files have the layer variance, a z-test compares blocks of 16x16 pixels (block p: the "
        "smallest)\n"
        "and the whole (whole p); 'differs' marks a picture for which one is too small for chance. A file "
        "drawn with\n"
        "--denoise ('filtered') has no z-test: its pixels depend on each other, and the test takes them for "
        "independent.");
}

void addAccuracy(CLI::App& app, AccuracyOptions& options) {
    addSource(app, options.source);
    app.add_flag("--temporal", options.temporal,
                 "Of each frame of a camera's path, by each way to take noise out")
        ->required();
    addPath(app, fmt::format("Which path (default: {})", options.path.path),
            [&options]() -> PathRequest& { return options.path; });
    addSize(app, options.size, "as for render");
    addDevice(app, options.device);
    for (const Setting& setting : settingsTable())
        if (setting.option == "--bounces" || setting.option == "--seed")
            addSetting(app, setting, options.run);
    addValue(app, "--spp", "N",
             fmt::format("Samples per pixel of a frame (default: {})", kDefaultFrameSamples),
             [&options](std::string_view option, std::string_view text) {
                 options.run.samples = parseCount32(option, text, 1, kMostSamples);
             });
    addValue(app, "--reference-spp", "N",
             fmt::format("Samples of the pictures that are taken for the truth, rounded up to even "
                         "(default: {})",
                         kDefaultReferenceSamples),
             [&options](std::string_view option, std::string_view text) {
                 options.reference_samples = parseCount32(option, text, 2, kMostSamples);
             });
    const auto addFile = [&app](const char* name, const char* meaning,
                                std::optional<std::filesystem::path>& file) {
        addValue(app, name, "FILE", meaning,
                 [&file](std::string_view, std::string_view text) { file = text; });
    };
    addFile("--json", "Write all numbers as JSON", options.json);
    addFile("--csv", "Write the frames' numbers as a table", options.csv);
    addFile("--svg", "Draw the frames' errors as a plot", options.svg);
    app.add_flag("--quiet", options.quiet, "Show no progress and no warnings");
    app.footer(
        "relMSE: against the converged picture of the same frame, whose own error is taken off; of raw: by "
        "the first\n"
        "row's. FLIP: how much of the difference is seen, as compare says it.\n"
        "flicker: mean change from frame to frame beyond that of the converged pictures, over their mean.\n"
        "ghost: relative squared error beyond that of raw frames, where a frame shows what the one before "
        "did not.\n"
        "recovers: frames until the error is within a tenth of a history's that began with the change: after "
        "a cut,\n"
        "after the light changed, where something came into sight; -: not in 16, or there was none.");
}

void addMemoryLimit(CLI::App& app) {
    addValue(app, "--memory-limit", "SIZE",
             "The most memory to take, as in 500M, 8G (default: most of what is free)",
             [](std::string_view option, std::string_view text) { limitMemory(parseMemory(option, text)); });
}

}  // namespace licht
