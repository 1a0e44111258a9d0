#include "samples/licht/camera_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "licht/core/error.h"
#include "licht/render/view.h"
#include "samples/licht/orbit_camera.h"
#include "samples/licht/path_file.h"
#include "samples/licht/text.h"

namespace licht {
namespace {

constexpr double kPeriod = 4.0;              ///< seconds, to and fro
constexpr double kSwing = 15.0 / 180.0;      ///< half turns to either side
constexpr double kStride = 0.1;              ///< to either side, in distances to what is looked at
constexpr double kTurnOfCut = 40.0 / 180.0;  ///< half turns

/// A frame of so many, at its time in seconds.
struct Moment {
    std::uint32_t frame;
    std::uint32_t frames;
    double seconds;
};

double toAndFro(double seconds) {
    return std::sin(2.0 * glm::pi<double>() * seconds / kPeriod);
}

/// In its middle exactly what it began with.
OrbitCamera swung(OrbitCamera camera, double seconds) {
    const double share = toAndFro(seconds);
    if (share != 0.0) camera.orbit(static_cast<float>(glm::pi<double>() * kSwing * share), 0.0F);
    return camera;
}

PathFrame orbit(const OrbitCamera& start, const Moment& now) {
    return {swung(start, now.seconds).camera(), ViewChange::motion};
}

PathFrame rest(const OrbitCamera& start, const Moment& /*now*/) {
    return {start.camera(), ViewChange::motion};
}

PathFrame strafe(const OrbitCamera& start, const Moment& now) {
    OrbitCamera camera = start;
    const double share = toAndFro(now.seconds);
    if (share != 0.0) camera.walk(static_cast<float>(kStride * share), 0.0F);
    return {camera.camera(), ViewChange::motion};
}

PathFrame cut(const OrbitCamera& start, const Moment& now) {
    OrbitCamera camera = start;
    const std::uint32_t second_half = (now.frames + 1) / 2;
    if (now.frame < second_half) return {camera.camera(), ViewChange::motion};
    camera.orbit(static_cast<float>(-glm::pi<double>() * kTurnOfCut), 0.0F);
    return {camera.camera(), now.frame == second_half ? ViewChange::cut : ViewChange::motion};
}

PathFrame stillMoveStill(const OrbitCamera& start, const Moment& now) {
    const std::uint32_t third = now.frames / 3;
    const std::uint32_t moved = std::clamp(now.frame, third, 2 * third) - third;
    return {swung(start, now.frame > 0 ? moved * (now.seconds / now.frame) : 0.0).camera(),
            ViewChange::motion};
}

struct Row {
    BuiltinPath path;
    PathFrame (*at)(const OrbitCamera& start, const Moment& now);
};

constexpr auto kRows = std::to_array<Row>({
    {{"orbit", "swings about what the camera looks at, 15 degrees to either side in 4 seconds"}, orbit},
    {{"strafe", "walks to either side, a tenth of the distance in 4 seconds"}, strafe},
    {{"cut", "rests, and half-way sees the scene from 40 degrees aside"}, cut},
    {{"rest", "rests: what moves is the scene"}, rest},
    {{"still-move-still", "rests for a third of the frames, swings for a third, and rests again"},
     stillMoveStill},
});

std::string pathNames() {
    std::string names;
    for (const BuiltinPath& path : builtinPaths()) names += fmt::format("{}, ", path.name);
    return names;
}

}  // namespace

std::span<const BuiltinPath> builtinPaths() {
    static const auto kPaths = [] {
        std::array<BuiltinPath, kRows.size()> paths;
        std::transform(kRows.begin(), kRows.end(), paths.begin(), [](const Row& row) { return row.path; });
        return paths;
    }();
    return kPaths;
}

bool isPathFile(const PathRequest& request) {
    return lowerCase(std::filesystem::path(request.path).extension().string()) == ".json";
}

std::vector<PathFrame> followPath(const PathRequest& request, const NamedScene& source, const Shot& start) {
    const auto row = std::find_if(kRows.begin(), kRows.end(),
                                  [&](const Row& known) { return known.path.name == request.path; });
    const Bounds bounds = sceneBounds(source.scene);
    const OrbitCamera at_start(start.camera, bounds);
    std::optional<CameraKeys> keys;
    if (row == kRows.end()) {
        if (!isPathFile(request))
            throw InputError(
                fmt::format("--path {}: is none of {}and no .json file", request.path, pathNames()));
        keys = readPathFile(request.path, source.scene, start.camera);
    }
    std::vector<PathFrame> frames;
    for (std::uint32_t i = 0; i < request.frames; ++i) {
        const double seconds = i / request.rate;
        frames.push_back(
            keys ? PathFrame{keys->at(seconds), keys->cutsBetween((i - 1.0) / request.rate, seconds)
                                                    ? ViewChange::cut
                                                    : ViewChange::motion}
                 : row->at(at_start, {i, request.frames, seconds}));
        static_cast<void>(makeView(frames.back().camera, start.size, bounds));  // throws
    }
    return frames;
}

}  // namespace licht
