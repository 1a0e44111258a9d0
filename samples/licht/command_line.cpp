#include "samples/licht/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <limits>

#include "licht/core/error.h"
#include "licht/run/pilot.h"
#include "licht/settings/settings.h"
#include "samples/licht/text.h"
#include "samples/scenes/builtin.h"

namespace licht {
namespace {

constexpr std::uint32_t kMaxCount32 = std::numeric_limits<std::uint32_t>::max();

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
    CLI::Option* environment =
        addValue(app, "--environment", "FILE", "Latitude-longitude sky, .hdr or .exr, in cd/m^2",
                 [&source](std::string_view, std::string_view text) { source.environment = text; });
    addValue(app, "--background", "R,G,B", "Constant sky in cd/m^2, linear Rec. 709",
             [&source](std::string_view option, std::string_view text) {
                 source.background = parseColour(option, text);
             })
        ->excludes(environment);
    addValue(app, "--sun-angle", "DEGREES",
             "Angle that directional lights fill, 0 to 180; the sun's is 0.53 (default: 0, sharp shadows)",
             [&source](std::string_view option, std::string_view text) {
                 source.sun_angle = parseAngle(option, text);
             });
}

void addLook(CLI::App& app, std::optional<uvec2>& size, std::optional<double>& exposure, Tonemap& tonemap,
             std::string& device, const std::string& default_size) {
    addValue(app, "--size", "WxH", "Width and height in pixels (default: " + default_size + ")",
             [&size](std::string_view option, std::string_view text) { size = parseSize(option, text); });
    addValue(app, "--exposure", "EV",
             "Display exposure in stops: values are multiplied by 2^EV (default: the scene's)",
             [&exposure](std::string_view option, std::string_view text) {
                 exposure = parseExposure(option, text);
             });
    addValue(app, "--tonemap", "CURVE", "Display curve: none, neutral, agx or aces (default: neutral)",
             [&tonemap](std::string_view option, std::string_view text) {
                 tonemap = parseChoice<Tonemap>(option, text);
             });
    addDevice(app, device);
}

/// `automatic`: set by "--bounces auto"; null where that is not offered.
void addTransport(CLI::App& app, RenderSettings& settings, bool* automatic) {
    const std::string meaning = "0: emission alone, 1: and direct light, and so on (default: 8)";
    addValue(
        app, "--bounces", automatic != nullptr ? "N|auto" : "N",
        automatic == nullptr
            ? meaning
            : meaning + fmt::format("; auto: by a small pilot, until what is missing is less than --error "
                                    "(default: {}) of the light, at most {}",
                                    kDefaultTailShare, kMostAutoBounces),
        [&settings, automatic](std::string_view option, std::string_view text) {
            if (automatic != nullptr) *automatic = text == "auto";
            if (automatic == nullptr || !*automatic)
                settings.bounces = parseCount32(option, text, 0, kMaxBounces);
        });
    addValue(app, "--seed", "N", "Same seed, same picture, bit for bit (default: 0)",
             [&settings](std::string_view option, std::string_view text) {
                 settings.seed = parseCount32(option, text, 0, kMaxCount32);
             });
}

/// How the integral is sampled: every choice has the same mean, and each its own noise and cost.
void addSampling(CLI::App& app, RenderSettings& settings) {
    const std::string group = "Sampling (same mean, other noise)";
    const auto add = [&app, &group](const std::string& name, const std::string& type,
                                    const std::string& meaning, auto& value, auto parse) {
        addValue(app, name, type, meaning, [&value, parse](std::string_view option, std::string_view text) {
            value = parse(option, text);
        })->group(group);
    };
    add("--direct", "HOW",
        "Direct light by mis (lights and scattering combined), hemisphere (scattering alone) or area (lights "
        "alone) (default: mis)",
        settings.direct, parseChoice<DirectLight>);
    add("--mis", "HOW", "Weights of mis: power or balance heuristic (default: power)", settings.mis,
        parseChoice<MisHeuristic>);
    add("--lights", "HOW",
        "Pick one of many lights by tree (near and facing first), power or uniform (default: tree)",
        settings.lights, parseChoice<LightChoice>);
    add("--environment-sampling", "HOW",
        "Draw a direction to the environment by inversion, alias or rejection (default: inversion)",
        settings.environment_sampling, parseChoice<EnvironmentSampling>);
    add("--sampler", "HOW",
        "Numbers from sobol (Owen-scrambled), blue (errors spread as blue noise, for few samples) or random "
        "(default: sobol)",
        settings.sampler, parseChoice<Sequence>);
    app.add_flag("--adaptive", settings.adaptive,
                 "Draw more samples where the noise is; --spp is then the mean over the pixels")
        ->group(group);
}

/// Shortcuts that change the picture's mean; the report says by how much.
void addBiased(CLI::App& app, RenderSettings& settings) {
    const std::string group = "Biased shortcuts (the report says what they take)";
    addValue(app, "--clamp", "LIMIT",
             "Cut what one path finds after two or more scatterings down to this, in cd/m^2",
             [&settings](std::string_view option, std::string_view text) {
                 settings.clamp = parsePositiveFloat(option, text);
             })
        ->group(group);
    app.add_flag("--regularise", settings.regularise, "Widen glossy lobes behind a path's first scattering")
        ->group(group);
}

void addExpert(CLI::App& app, RenderSettings& settings, QueueUse& queues) {
    const std::string group = "Expert options";
    addValue(app, "--roulette", "BOUNCE",
             "First bounce that may end a path by chance, keeping the mean (default: 3)",
             [&settings](std::string_view option, std::string_view text) {
                 settings.roulette_start = parseCount32(option, text, 0, kMaxCount32);
             })
        ->group(group);
    addValue(app, "--first-sample", "N",
             "Index of the first sample: ranges rendered apart merge to the whole (default: 0)",
             [&settings](std::string_view option, std::string_view text) {
                 settings.first_sample = parseCount32(option, text, 0, kMaxCount32 - 1);
             })
        ->group(group);
    app.add_flag("--all-effects", settings.all_effects,
                 "Compile every effect, whether the scene calls for it or not")
        ->group(group);
    addValue(app, "--bvh", "QUALITY",
             "How well the BVH is built: fast, balanced or best; better trees take longer to build "
             "(default: balanced)",
             [&settings](std::string_view option, std::string_view text) {
                 settings.bvh_quality = parseChoice<BvhQuality>(option, text);
             })
        ->group(group);
    // A flag, so that a value stands behind a "=" and a scene may follow it.
    const std::string queues_meaning =
        "Follow paths by small kernels with queues between them instead of one kernel, the same samples: "
        "--queues=on, off or auto, where it pays (default: auto)";
    app.add_flag("--queues{on}", queues_meaning)
        ->each([&queues](const std::string& text) { queues = parseChoice<QueueUse>("--queues", text); })
        ->group(group);
    app.add_flag("--flatten-instances", settings.flatten_instances,
                 "Store every instance of a mesh as triangles of its own")
        ->group(group);
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
    addLook(app, options.size, options.exposure, options.tonemap, options.device,
            "height 540, width by the camera, 960x540 if it does not say");
    addValue(
        app, "--spp", "N",
        fmt::format("Samples per pixel (default: {} unless --time or --error is given)", kDefaultSamples),
        [&options](std::string_view option, std::string_view text) {
            options.samples = parseCount32(option, text, 1, kMaxCount32);
        });
    addValue(app, "--time", "SECONDS", "Stop after that many seconds of rendering",
             [&options](std::string_view option, std::string_view text) {
                 options.seconds = parsePositive(option, text);
             });
    addValue(app, "--error", "REL",
             "Stop at that estimated relative error (square root of relMSE); 0.01 is a clean picture",
             [&options](std::string_view option, std::string_view text) {
                 options.error = parsePositive(option, text);
             });
    addTransport(app, options.settings, &options.auto_bounces);
    addValue(app, "--aov", "LIST",
             "Layers for .exr outputs: all, or from albedo,normal,depth,motion,variance,sampleCount,bounces",
             [&options](std::string_view option, std::string_view text) {
                 options.layers = parseLayers(option, text);
             });
    addValue(app, "--report", "FILE", "Write what was done and what it cost as JSON",
             [&options](std::string_view, std::string_view text) { options.report = text; });
    app.add_flag("--quiet", options.quiet, "Say nothing but errors");
    addSampling(app, options.settings);
    addBiased(app, options.settings);
    addExpert(app, options.settings, options.queues);
}

void addView(CLI::App& app, ViewOptions& options) {
    addSource(app, options.source);
    addLook(app, options.size, options.exposure, options.tonemap, options.device, "as for render");
    addTransport(app, options.settings, nullptr);
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
             "How well the BVH is built: fast, balanced or best (default: balanced)",
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
    const AovSet& aovs = options.layers.aovs;
    const bool layers = aovs.any() || options.layers.variance || options.layers.sample_count;
    const bool exr = std::any_of(options.outputs.begin(), options.outputs.end(), isExr);
    if (layers && !exr) throw InputError("--aov: layers are stored in .exr files only: add -o FILE.exr");
    if (options.layers.orders && !exr && !options.report)
        throw InputError(
            "--aov bounces: the layers are stored in .exr files and summed up in the report: add -o FILE.exr "
            "or --report FILE");
    if (options.samples && *options.samples > kMaxCount32 - options.settings.first_sample)
        throw InputError(fmt::format("--first-sample {} and --spp {}: sample indices end at {}",
                                     options.settings.first_sample, *options.samples, kMaxCount32));
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
    info_app->add_option("SCENE", info.scene, sceneHelp())->required()->type_name("");
    info_app->add_flag("--json", info.json, "As JSON");
    CLI::App* bench_app = app.add_subcommand("bench", "Measure how fast rays find their hits in a scene");
    addBench(*bench_app, bench);
    CLI::App* devices_app =
        app.add_subcommand("devices", "List every Vulkan device, chosen or refused with all reasons");
    devices_app->add_flag("--json", devices.json, "As JSON");
    CLI::App* compare_app = app.add_subcommand("compare", "Measure how far pictures are from a reference");
    addCompare(*compare_app, compare);

    try {
        app.parse(argument_count, arguments);
    } catch (const CLI::CallForHelp&) {
        return PrintedText{app.help()};
    } catch (const CLI::CallForVersion& call) {
        return PrintedText{std::string(call.what()) + "\n"};
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
    render.settings.orders = render.layers.orders;
    render.settings.blue_bits = blueBitsFor(render.samples);
    return render;
}

}  // namespace licht
