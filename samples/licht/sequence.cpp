#include "samples/licht/sequence.h"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <set>
#include <system_error>

#include "licht/core/clock.h"
#include "licht/core/error.h"
#include "licht/film/error_estimate.h"
#include "licht/oidn/oidn.h"
#include "licht/run/process_clock.h"
#include "samples/licht/camera_path.h"
#include "samples/licht/frame_pattern.h"
#include "samples/licht/interrupt.h"
#include "samples/licht/outputs.h"
#include "samples/licht/render_steps.h"
#include "samples/licht/scene_in_time.h"
#include "samples/licht/text.h"

namespace licht {
namespace {

/// Files of a sequence: one of each pattern for a frame.
class FrameFiles {
public:
    explicit FrameFiles(const std::vector<std::filesystem::path>& patterns)
        : patterns_(patterns.begin(), patterns.end()) {}

    [[nodiscard]] std::vector<std::filesystem::path> of(std::uint32_t frame) const {
        std::vector<std::filesystem::path> files;
        for (const FramePattern& pattern : patterns_) files.push_back(pattern.of(frame));
        return files;
    }
    /// The first frame of which a file is missing; they appear whole or not at all.
    [[nodiscard]] std::uint32_t firstMissing(std::uint32_t frames) const {
        for (std::uint32_t frame = 0; frame < frames; ++frame)
            for (const auto& file : of(frame))
                if (!isThere(file)) return frame;
        return frames;
    }
    /// Throws InputError before the work is done: where a file is another one or one that is read, or could
    /// not be written.
    void check(const RenderOptions& options, const Scene& scene) const {
        std::vector<std::filesystem::path> folders;
        for (const auto& file : of(0)) {
            checkWritable(file);  // the others lie beside it
            folders.push_back(placeOf(file).parent_path());
        }
        requireFilesOfItsOwn(options, scene, of(0));
        std::set<std::filesystem::path> taken;
        if (options.report) taken.insert(placeOf(*options.report));
        for (std::uint32_t frame = 0; frame < options.path->frames; ++frame) {
            const std::vector<std::filesystem::path> files = of(frame);
            for (std::size_t i = 0; i < files.size(); ++i) {
                // Two patterns may meet in different frames: "1%d.png" and "%d.png" in 1 and 11.
                if (!taken.insert(folders[i] / files[i].filename()).second)
                    throw InputError(
                        fmt::format("{}: cannot write, it is named for two files", files[i].string()));
                if (!isThere(files[i])) continue;
                checkWritable(files[i]);
                requireFilesOfItsOwn(options, scene, files);
            }
        }
    }

private:
    static bool isThere(const std::filesystem::path& file) {
        std::error_code ignored;
        return std::filesystem::exists(file, ignored);
    }
    static std::filesystem::path placeOf(const std::filesystem::path& file) {
        std::error_code ignored;
        return std::filesystem::weakly_canonical(std::filesystem::absolute(file, ignored), ignored);
    }

    std::vector<FramePattern> patterns_;
};

/// Where a sequence begins, so that frame `wanted` is as if it had begun at the first: nothing before a cut
/// tells of what comes behind it.
std::uint32_t firstThatTells(const std::vector<PathFrame>& path, std::uint32_t wanted) {
    if (wanted == path.size()) return wanted;
    while (wanted > 0 && path[wanted].change != ViewChange::cut) --wanted;
    return wanted;
}

/// What is drawn: a frame after the other, each with its files.
class SequenceRun {
public:
    SequenceRun(const RenderOptions& options, const std::vector<PathFrame>& path, const FrameFiles& files,
                RenderReport& report, double exposure, Oidn* oidn)
        : options_(options), path_(path), files_(files), report_(report), exposure_(exposure), oidn_(oidn) {}

    /// Frames from `first` on; the last one's film. Stops early where a file cannot be written.
    LoopResult draw(gpu::Device& device, Renderer& renderer, std::uint32_t first, FilesWritten& written,
                    ProgressLine& progress, const InterruptWatch& interrupt) {
        const Clock::time_point start = Clock::now();
        LoopResult result;
        describeRun(report_, device, renderer, result);
        const std::uint32_t begun = firstThatTells(path_, first);
        for (std::uint32_t frame = begun; frame < path_.size() && written.all(); ++frame) {
            const Clock::time_point frame_start = Clock::now();
            PathFrame shown = path_[frame];
            if (frame == begun) shown.change = ViewChange::cut;
            showFrame(renderer, shown);
            for (std::uint32_t i = 0; i < *options_.run.samples && !interrupt.asked(); ++i)
                renderer.renderSample();
            if (interrupt.asked()) {
                result.stopped_by = Stop::interrupt;
                break;
            }
            if (frame < first) continue;
            result.film = renderer.readFilm();
            if (oidn_ != nullptr) oidn_->filter(result.film);
            result.error = relativeError(result.film);
            if (frame == first) result.first_image_seconds = secondsSinceProcessStart();
            report_.sequence->frames.push_back(
                {frame, secondsSince(frame_start), result.error, path_[frame].change == ViewChange::cut});
            result.render_seconds = secondsSince(start);
            describeRun(report_, device, renderer, result);
            for (const auto& file : files_.of(frame))
                if (writePicture(written, file, renderer, result.film, report_, exposure_))
                    report_.outputs.push_back(file);
            progress.show(progressText(frame, secondsSince(start), begun));
        }
        if (result.stopped_by == Stop::none) result.stopped_by = Stop::samples;
        report_.stopped_by = result.stopped_by;
        return result;
    }

private:
    [[nodiscard]] std::string progressText(std::uint32_t frame, double seconds, std::uint32_t begun) const {
        const double left = seconds / (frame + 1.0 - begun) * static_cast<double>(path_.size() - frame - 1);
        return fmt::format("frame {}/{}  {:.1f} s  {:.1f} s left", frame + 1, path_.size(), seconds, left);
    }

    const RenderOptions& options_;
    const std::vector<PathFrame>& path_;
    const FrameFiles& files_;
    RenderReport& report_;
    double exposure_;
    Oidn* oidn_;  ///< null: frames stay as they are
};

std::string sequenceLine(const RenderReport& report, std::size_t frames) {
    const std::vector<FrameReport>& drawn = report.sequence->frames;
    std::string line = fmt::format("{} of {} frames", drawn.size(), frames);
    if (drawn.empty()) return line;
    double seconds = 0.0;
    for (const FrameReport& frame : drawn) seconds += frame.seconds;
    return line + fmt::format(" in {:.2f} s, {:.1f} ms each", report.render_seconds,
                              1000.0 * seconds / static_cast<double>(drawn.size()));
}

/// As asked, with what a sequence chooses where nobody says.
RenderOptions completed(RenderOptions options, const NamedScene& source) {
    if (options.outputs.empty()) {
        options.outputs.emplace_back(source.name + "-%04d.png");
        const FramePattern pattern(options.outputs.front());
        for (std::uint32_t frame = 0; frame < options.path->frames; ++frame)
            requireNoStranger(pattern.of(frame));
    }
    if (!options.run.samples) options.run.samples = kDefaultFrameSamples;
    return options;
}

}  // namespace

int renderSequence(const RenderOptions& asked) {
    const Clock::time_point load_start = Clock::now();
    const NamedScene source = loadScene(asked.source);
    const Shot shot = chooseShot(source, asked.source.camera, asked.size);
    const RenderOptions options = completed(asked, source);
    std::vector<PathFrame> path = followPath(*options.path, source, shot);
    addScenes(path, source, options.source, options.path->rate);
    const FrameFiles files(options.outputs);
    files.check(options, source.scene);
    if (options.report) checkWritable(*options.report);
    RenderReport report = beginReport(options, source, shot);
    report.outputs.clear();
    report.sequence = SequenceReport{options.path->path, options.path->rate, {}};
    report.load_seconds = secondsSince(load_start);

    std::optional<ProgressLine> progress(std::in_place, stderr, options.quiet);
    gpu::Device device(deviceOptions(options.device, progress));
    RunSettings run = options.run;
    run.render.size = shot.size;
    run.render.moves = true;
    run.render.scene_moves = moves(source);
    const RunPlan plan = planRun(device, source.scene, path.front().camera, run, options.path->frames);
    notePlan(report, plan);
    const std::unique_ptr<Oidn> oidn = plan.oidn ? makeOidn() : nullptr;
    Renderer renderer(device, source.scene, path.front().camera, plan.settings);
    progress->clear();
    if (!options.quiet) {
        warnOfPlan(plan, device.report());
        printWarnings(source.scene);
    }

    const std::uint32_t first = options.resume ? files.firstMissing(options.path->frames) : 0;
    FilesWritten written;
    const double exposure = options.run.exposure.value_or(source.scene.default_exposure);
    InterruptWatch interrupt;
    const LoopResult result = SequenceRun(options, path, files, report, exposure, oidn.get())
                                  .draw(device, renderer, first, written, *progress, interrupt);
    progress.reset();
    interrupt.shield();
    report.statistics = renderer.statistics();
    if (!options.quiet) {
        warnOfDoubts(report);
        if (result.film.samples > 0) warnOfBlackness(result.film, exposure);
    }
    writeReport(written, options, report);
    const std::string line = sequenceLine(report, path.size());
    if (!options.quiet) printOut(line + "\n");
    if (result.stopped_by == Stop::interrupt)
        printError(fmt::format("licht: interrupted: {}; --resume goes on there\n", line));
    return endRun(written, device);
}

}  // namespace licht
