#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "licht/film/film.h"
#include "licht/gpu/device.h"
#include "licht/render/statistics.h"
#include "licht/run/pilot.h"
#include "licht/run/render_loop.h"
#include "licht/settings/settings.h"
#include "samples/licht/options.h"
#include "samples/licht/scene_source.h"

namespace licht {

struct FrameReport {
    std::uint32_t frame = 0;
    double seconds = 0.0;  ///< of rendering and filtering
    double error = -1.0;   ///< relative, estimated
    bool cut = false;
};

/// The frames of a camera's path that this run drew.
struct SequenceReport {
    std::string path;
    double rate = 0.0;  ///< frames a second
    std::vector<FrameReport> frames;
};

/// What a picture was made of and what it cost.
struct RenderReport {
    std::string scene;
    std::string device;
    std::string driver;
    std::string camera;
    std::string environment;            ///< its name; empty: there is none
    double environment_rotation = 0.0;  ///< degrees about +Y
    double environment_strength = 1.0;
    uvec2 size{0};
    std::uint32_t samples = 0;
    RunSettings asked;
    RenderSettings settings;  ///< as they were in the end
    Stop stopped_by = Stop::none;
    double load_seconds = 0.0;
    double first_image_seconds = 0.0;  ///< from process start
    double render_seconds = 0.0;
    double total_seconds = 0.0;      ///< from process start until the pictures were written
    double error = -1.0;             ///< negative: unknown
    double filter_bias = -1.0;       ///< relative, estimated; negative: not filtered
    double unfiltered_error = -1.0;  ///< of the picture before the filter; negative: not filtered, or unknown
    RenderStatistics statistics;
    glm::dvec3 mean{0.0};                       ///< of the picture, cd/m^2
    std::vector<LightBatch> light;              ///< where orders are kept or the clamp is on
    std::optional<DepthChoice> depth;           ///< of --bounces auto
    std::optional<BiasMeasure> regularisation;  ///< where it is on
    std::optional<SequenceReport> sequence;     ///< where a path was followed; the rest is of its last frame
    std::uint32_t fewest_samples = 0;           ///< of a pixel, where adaptive
    std::uint32_t most_samples = 0;
    std::vector<std::string> effects;
    std::uint64_t host_peak_bytes = 0;
    std::uint64_t device_peak_bytes = 0;
    std::vector<SceneNote> notes;
    std::vector<std::filesystem::path> outputs;

    [[nodiscard]] std::uint64_t rays() const {
        return statistics.primary_rays + statistics.bounce_rays + statistics.shadow_rays;
    }
};

/// The most memory this process ever held.
std::uint64_t hostPeakBytes();

std::string reportJson(const RenderReport& report);
/// The attributes of an EXR file that say how it was made.
std::vector<std::pair<std::string, std::string>> reportAttributes(const RenderReport& report);
/// "64 samples in 3.2 s, relative error 0.031"
std::string reportLine(const RenderReport& report);

}  // namespace licht
