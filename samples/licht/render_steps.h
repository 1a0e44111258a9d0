#pragma once
// What a picture and a sequence of pictures do alike, from what was asked for to files that are there.
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "licht/core/progress.h"
#include "licht/gpu/device.h"
#include "licht/oidn/oidn.h"
#include "licht/render/renderer.h"
#include "licht/run/plan.h"
#include "licht/run/render_loop.h"
#include "samples/licht/options.h"
#include "samples/licht/report.h"
#include "samples/licht/scene_source.h"

namespace licht {

/// What is known before anything is drawn: what was asked for, and where the pictures go. Throws InputError
/// where the default one would replace a stranger.
RenderReport beginReport(const RenderOptions& options, const NamedScene& source, const Shot& shot);

/// What is read of a scene, its sky and a camera's path.
std::vector<std::filesystem::path> filesRead(const SceneRequest& request, const Scene& scene,
                                             const std::optional<PathRequest>& path);

/// Throws InputError where one of the files that a run gives is one that it takes, or another one.
void requireFilesOfItsOwn(const RenderOptions& options, const Scene& scene,
                          std::vector<std::filesystem::path> outputs);

/// Long compilations show which program they are at.
gpu::DeviceOptions deviceOptions(const std::string& device, std::optional<ProgressLine>& progress);

/// What the plan chose.
void notePlan(RenderReport& report, const RunPlan& plan);

/// The pilot found no depth that spends the light, or the device cannot be trusted with queues.
void warnOfPlan(const RunPlan& plan, const gpu::DeviceReport& device);

/// The picture goes through the network, which takes time and whose error is not known.
void filterOnHost(Oidn& oidn, LoopResult& result);

void describeRun(RenderReport& report, const gpu::Device& device, const Renderer& renderer,
                 const LoopResult& result);

/// What makes a picture doubtful is said, not only reported.
void warnOfDoubts(const RenderReport& report);
/// A picture that shows nothing says why.
void warnOfBlackness(const Film& film, double exposure);

/// A picture that is there is not lost because another file cannot be written: says why and which files are
/// whole, and goes on.
class FilesWritten {
public:
    /// Whether it was written.
    bool add(const std::filesystem::path& path, const std::function<void()>& write);
    [[nodiscard]] bool all() const { return all_; }

private:
    std::string whole_;
    bool all_ = true;
};

/// As EXR with layers and attributes, or PNG as a display shows it.
bool writePicture(FilesWritten& files, const std::filesystem::path& output, Renderer& renderer,
                  const Film& film, const RenderReport& report, double exposure);

/// The picture before the filter, where it is asked for.
void writeUnfiltered(FilesWritten& files, const RenderOptions& options, Renderer& renderer, double exposure);

/// The report with what is known at the end, where one is asked for.
void writeReport(FilesWritten& files, const RenderOptions& options, RenderReport& report);

/// What a run leaves by: the exit code, or the process at once where the device hangs.
int endRun(const FilesWritten& files, const gpu::Device& device);

}  // namespace licht
