#pragma once
// What each subcommand can be told, and the parsers of the values that are no settings of a run
// (settings/parse.h has the others).
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "licht/settings/parse.h"
#include "licht/settings/settings.h"

namespace licht {

inline constexpr std::uint32_t kMaxPictureSide = 16384;
inline constexpr std::uint64_t kMaxPicturePixels = std::uint64_t{1} << 27U;
inline constexpr double kWidestSun = 180.0;    ///< degrees
inline constexpr double kMostRotation = 3600;  ///< degrees, of a sky
/// Each side 0 (as the other side and the camera say) to kMaxPictureSide, not both 0.
struct SizeRequest {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
};

inline constexpr std::uint32_t kDefaultFrames = 96;
inline constexpr std::uint32_t kMostFrames = 1'000'000;
inline constexpr double kDefaultRate = 24.0;
inline constexpr std::uint32_t kDefaultFrameSamples = 1;  ///< per pixel of a path's frame
inline constexpr double kMostRate = 1e6;
inline constexpr std::uint32_t kDefaultReferenceSamples = 512;  ///< of a frame that others are measured by

/// Which scene, seen how, lit by what. Shared by render and view.
struct SceneRequest {
    std::string scene;                       ///< built-in name or path of a .gltf or .glb
    std::optional<std::string> camera;       ///< name or index; none: the first, or one that frames the scene
    std::optional<std::string> environment;  ///< path of an .hdr or .exr
    std::optional<vec3> background;          ///< cd/m^2, a constant sky; excludes environment
    std::optional<double> environment_rotation;  ///< degrees about +Y, counter-clockwise from above
    std::optional<double> environment_strength;  ///< factor on the sky
    std::optional<double> sun_angle;  ///< degrees that directional lights fill; none: the scene's own
    std::uint64_t triangles = 0;      ///< of a built-in scene that takes a count; 0: its own
    bool strict = false;              ///< images that cannot be read are errors
};

/// Which path of a camera, a built-in name or a .json file, in how many frames, how many of them a second.
struct PathRequest {
    std::string path;
    std::uint32_t frames = kDefaultFrames;  ///< at least one
    double rate = kDefaultRate;             ///< finite, above zero
};

struct RenderOptions {
    SceneRequest source;
    RunSettings run;                             ///< render.size is filled in from the field beside it
    std::vector<std::filesystem::path> outputs;  ///< .png and .exr; empty: "<scene name>.png"
    std::optional<PathRequest> path;  ///< a picture for each of its frames; outputs are then patterns
    std::optional<std::filesystem::path> unfiltered;  ///< .png: the picture as it was before the filter
    bool resume = false;                              ///< the path's frames that are there stay
    std::optional<SizeRequest> size;
    std::string device;
    std::optional<std::filesystem::path> report;
    bool quiet = false;
};

struct InfoOptions {
    SceneRequest source;
    bool json = false;
};

inline constexpr std::uint64_t kDefaultBenchTriangles = 300'000;  ///< of scenes that take a count
inline constexpr std::uint32_t kDefaultBenchRuns = 5;

struct BenchOptions {
    SceneRequest source;
    std::optional<SizeRequest> size;
    std::uint32_t runs = kDefaultBenchRuns;
    BvhQuality quality = RenderSettings{}.bvh_quality;
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
    RunSettings run;
    std::optional<SizeRequest> size;
    std::string device;
    std::uint64_t frames = 0;  ///< 0: until the window is closed
};

struct AccuracyOptions {
    SceneRequest source;
    RunSettings run;  ///< its samples are those of a frame
    PathRequest path{"strafe"};
    bool temporal = false;
    std::uint32_t reference_samples = kDefaultReferenceSamples;
    std::optional<SizeRequest> size;
    std::string device;
    std::optional<std::filesystem::path> json, csv, svg;
    bool quiet = false;
};

/// How many triangles: "250000", "300k", "1.5M"; kFewestTriangles to kMostTriangles.
std::uint64_t parseTriangles(std::string_view option, std::string_view text);
/// A share of the machine's memory: "500M", "8G", "2.5GiB"; at least 16 MiB.
std::uint64_t parseMemory(std::string_view option, std::string_view text);
/// "960x540", "960", "960x" or "x540": each side that is said 1 to kMaxPictureSide, at most kMaxPicturePixels
/// together.
SizeRequest parseSize(std::string_view option, std::string_view text);
/// "R,G,B": finite, not negative.
vec3 parseColour(std::string_view option, std::string_view text);
/// "albedo,normal,..." or "all".
LayerSet parseLayers(std::string_view option, std::string_view text);
/// A path that ends in .png or .exr.
std::filesystem::path parseOutput(std::string_view option, std::string_view text);

}  // namespace licht
