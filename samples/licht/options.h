#pragma once
// What each subcommand can be told, and the parsers of option values. A parser names the option, the value
// and what is allowed.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "licht/bvh/bvh.h"
#include "licht/settings/settings.h"

namespace licht {

inline constexpr std::uint32_t kMaxPictureSide = 16384;
inline constexpr std::uint64_t kMaxPicturePixels = std::uint64_t{1} << 27U;
inline constexpr std::uint32_t kMaxBounces = 65535;
inline constexpr std::uint32_t kDefaultSamples =
    64;  ///< per pixel, where neither time nor error says when to stop

/// Which scene, seen how, lit by what. Shared by render and view.
struct SceneRequest {
    std::string scene;                       ///< built-in name or path of a .gltf or .glb
    std::optional<std::string> camera;       ///< name or index; none: the first, or one that frames the scene
    std::optional<std::string> environment;  ///< path of an .hdr or .exr
    std::optional<vec3> background;          ///< cd/m^2, a constant sky; excludes environment
    std::optional<double> sun_angle;         ///< degrees that directional lights fill; none: the scene's own
    std::uint64_t triangles = 0;             ///< of a built-in scene that takes a count; 0: its own
};

/// Layers of an EXR file beside R G B A.
struct Layers {
    AovSet aovs;
    bool variance = false;
    bool sample_count = false;
    bool orders = false;  ///< one per order T^i Le
};

struct RenderOptions {
    SceneRequest source;
    QueueUse queues = QueueUse::automatic;
    std::vector<std::filesystem::path> outputs;  ///< .png and .exr; empty: "<scene name>.png"
    std::optional<uvec2> size;
    std::optional<std::uint32_t> samples;
    std::optional<double> seconds;
    std::optional<double> error;
    bool auto_bounces = false;       ///< a pilot chooses settings.bounces
    RenderSettings settings;         ///< size and aovs are filled in from the fields beside it
    std::optional<double> exposure;  ///< EV; none: the scene's
    Tonemap tonemap = Tonemap::neutral;
    Layers layers;
    std::string device;
    std::optional<std::filesystem::path> report;
    bool quiet = false;
};

struct InfoOptions {
    std::string scene;
    bool json = false;
};

inline constexpr std::uint64_t kDefaultBenchTriangles = 300'000;  ///< of scenes that take a count
inline constexpr std::uint32_t kDefaultBenchRuns = 5;

struct BenchOptions {
    SceneRequest source;
    std::optional<uvec2> size;
    std::uint32_t runs = kDefaultBenchRuns;
    BvhQuality quality = BvhQuality::balanced;
    std::string device;
    std::optional<std::filesystem::path> json;
    bool quiet = false;  ///< no progress
};

struct DevicesOptions {
    bool json = false;
};

struct CompareOptions {
    std::filesystem::path reference;
    std::vector<std::filesystem::path> pictures;
    std::optional<std::filesystem::path> json;
};

struct ViewOptions {
    SceneRequest source;
    std::optional<uvec2> size;
    std::optional<double> exposure;
    Tonemap tonemap = Tonemap::neutral;
    RenderSettings settings;
    std::string device;
    std::uint64_t frames = 0;  ///< 0: until the window is closed
};

/// How many triangles: "250000", "300k", "1.5M"; kFewestTriangles to kMostTriangles.
std::uint64_t parseTriangles(std::string_view option, std::string_view text);
/// "960x540": each side 1 to kMaxPictureSide, at most kMaxPicturePixels together.
uvec2 parseSize(std::string_view option, std::string_view text);
/// A whole number from lowest to highest.
std::uint64_t parseCount(std::string_view option, std::string_view text, std::uint64_t lowest,
                         std::uint64_t highest);
/// The same for the 32-bit settings.
std::uint32_t parseCount32(std::string_view option, std::string_view text, std::uint32_t lowest,
                           std::uint32_t highest);
/// Degrees, 0 to 180.
double parseAngle(std::string_view option, std::string_view text);
/// Finite and greater than zero.
double parsePositive(std::string_view option, std::string_view text);
/// The same, as a float.
float parsePositiveFloat(std::string_view option, std::string_view text);
/// An exposure value in stops, -64 to 64: beyond, 2^EV and a float radiance soon have no common range.
double parseExposure(std::string_view option, std::string_view text);
/// "R,G,B": finite, not negative.
vec3 parseColour(std::string_view option, std::string_view text);
/// One of what can be chosen by name (settings/choices.h).
template <typename Choice>
Choice parseChoice(std::string_view option, std::string_view text);
/// log2 of the samples that sampler blue spreads well together, for a picture of that many per pixel; 4 where
/// that is not known.
std::uint32_t blueBitsFor(std::optional<std::uint32_t> samples);
/// "albedo,normal,..." or "all".
Layers parseLayers(std::string_view option, std::string_view text);
/// A path that ends in .png or .exr.
std::filesystem::path parseOutput(std::string_view option, std::string_view text);

}  // namespace licht
