#include "licht/run/temporal_accuracy.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <numeric>
#include <optional>

#include "licht/core/clock.h"
#include "licht/core/memory.h"
#include "licht/measure/flip.h"
#include "licht/measure/metrics.h"
#include "licht/measure/statistics.h"
#include "licht/oidn/oidn.h"
#include "licht/run/disocclusion.h"

namespace licht {
namespace {

/// The converged picture of a frame: the mean of two of other samples, whose difference tells its error.
struct Truth {
    Image mean;
    Image depth;  ///< along the axis, metres
    ViewRecord view{};
    std::vector<double> squares;  ///< relative ones of each pixel's own error, on average
    double rel_mse = 0.0;         ///< their mean
    double light = 0.0;           ///< mean over pixels and channels
};

double sumOf(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

class Truths {
public:
    Truths(gpu::Device& device, const Scene& scene, const Camera& camera, RenderSettings settings,
           std::uint32_t samples)
        : samples_(samples / 2 + samples % 2), bounds_(sceneBounds(scene)), size_(settings.size) {
        settings.denoise = Denoise::none;
        settings.moves = false;
        settings.layers = {};
        settings.layers.add(LayerId::depth);
        for (auto& renderer : renderers_) {
            settings.seed = settings.seed * 2654435761U + 1U;  // far from the pictures' and from each other's
            renderer = std::make_unique<Renderer>(device, scene, camera, settings);
        }
    }

    /// Of a frame; one that shows what the last one did is not made again. Null where it is interrupted: a
    /// truth takes as long as hundreds of frames.
    const Truth* of(const PathFrame& frame, const std::function<bool()>& interrupted) {
        const ViewRecord view = makeView(frame.camera, size_, bounds_);
        if (!truth_.mean.texels.empty() && !frame.scene &&
            std::memcmp(&view, &truth_.view, sizeof(view)) == 0)
            return &truth_;
        std::array<Film, 2> films;
        for (std::size_t i = 0; i < films.size(); ++i) {
            showFrame(*renderers_[i], {frame.camera, ViewChange::cut, frame.scene});
            for (std::uint32_t sample = 0; sample < samples_; ++sample) {
                if (interrupted && interrupted()) return nullptr;
                renderers_[i]->renderSample();
            }
            films[i] = renderers_[i]->readFilm();
        }
        const Image one = withoutAlpha(films[0].mean);
        truth_ = {withoutAlpha(films[1].mean), films[0].layer(LayerId::depth), view, {}};
        for (std::size_t i = 0; i < one.texels.size(); ++i)
            truth_.mean.texels[i] = 0.5F * (truth_.mean.texels[i] + one.texels[i]);
        truth_.squares = relativeSquares(one, truth_.mean);  // a quarter of the difference's square
        truth_.rel_mse = sumOf(truth_.squares) / static_cast<double>(truth_.squares.size());
        truth_.light = sumOf(channelMeans(truth_.mean)) / 3.0;
        return &truth_;
    }

private:
    std::uint32_t samples_;
    Bounds bounds_;
    uvec2 size_;
    std::array<std::unique_ptr<Renderer>, 2> renderers_;
    Truth truth_;
};

/// What ways of taking noise out begin with.
struct Beginning {
    gpu::Device& device;
    const Scene& scene;
    const Camera& camera;
    const RenderSettings& settings;
};

/// A way of taking noise out, frame after frame.
class Runner {
public:
    Runner(const Beginning& beginning, Denoise mode, std::uint32_t samples)
        : beginning_(beginning), samples_(samples) {
        result_.mode = mode;
        if (mode == Denoise::oidn) oidn_ = makeOidn();
        beginAnew(beginning.settings.first_sample);
    }

    /// Nothing counts of what was drawn.
    void beginAnew(std::uint32_t first_sample) {
        RenderSettings settings = beginning_.settings;
        settings.denoise = oidn_ ? Denoise::none : result_.mode;
        settings.moves = true;
        settings.layers = oidn_ ? LayerSet{LayerId::albedo, LayerId::normal} : LayerSet{};
        settings.first_sample = first_sample;
        renderer_ =
            std::make_unique<Renderer>(beginning_.device, beginning_.scene, beginning_.camera, settings);
    }

    void draw(const PathFrame& frame) {
        const Clock::time_point start = Clock::now();
        showFrame(*renderer_, frame);
        for (std::uint32_t i = 0; i < samples_; ++i) renderer_->renderSample();
        previous_ = std::move(picture_);
        Film film = renderer_->readFilm();
        if (oidn_) oidn_->filter(film);
        picture_ = withoutAlpha(film.mean);
        if (result_.mode == Denoise::none) showFrameAlone(film.samples);
        result_.frames.push_back({secondsSince(start), 0.0, 0.0});
    }
    void compare(const Truth& truth) {
        squares_ = relativeSquares(picture_, truth.mean);
        result_.frames.back().rel_mse =
            sumOf(squares_) / static_cast<double>(squares_.size()) - truth.rel_mse;
        result_.frames.back().flip = flipAsDisplayed(picture_, truth.mean);
    }
    void addFlicker(const Image& before, const Image& now) {
        double sum = 0.0;
        for (std::size_t i = 0; i < now.texels.size(); ++i)
            sum += std::abs(changeOf(previous_, picture_, i) - changeOf(before, now, i));
        const double whole = std::accumulate(now.texels.begin(), now.texels.end(), 0.0);
        if (whole > 0.0) flicker_.add(sum / whole);
    }
    /// `raw`: squares of mode none.
    void addGhost(std::span<const double> raw, std::span<const std::uint32_t> ages) {
        for (std::size_t pixel = 0; pixel < ages.size(); ++pixel)
            if (ages[pixel] == 0) ghost_.add(squares_[pixel] - raw[pixel]);
    }
    void addRecovery(const FreshStarts& starts, std::span<const double> fresh, const Truth& truth,
                     std::span<const std::uint32_t> ages) {
        RecoveryStep step;
        for (std::size_t pixel = 0; pixel < ages.size(); ++pixel) {
            if (!starts.touched(ages[pixel])) continue;
            step.error += squares_[pixel] - truth.squares[pixel];
            step.fresh_error += fresh[pixel] - truth.squares[pixel];
            ++step.pixels;
        }
        result_.recoveries[static_cast<std::size_t>(starts.kind())].add(starts.framesSince(), step);
    }
    [[nodiscard]] std::span<const double> squares() const { return squares_; }
    [[nodiscard]] TemporalMode result() const {
        TemporalMode mode = result_;
        mode.flicker = flicker_.mean();
        mode.ghost = {ghost_.mean(), ghost_.count() < 2 ? -1.0 : std::sqrt(ghost_.varianceOfMean()),
                      ghost_.count()};
        return mode;
    }

private:
    /// Takes off what earlier frames of a resting camera have in the mean of all samples.
    void showFrameAlone(std::uint32_t samples) {
        Image mean = picture_;
        const double before = samples - samples_;
        for (std::size_t i = 0; before > 0.0 && i < mean.texels.size(); ++i)
            picture_.texels[i] =
                static_cast<float>((static_cast<double>(samples) * static_cast<double>(mean.texels[i]) -
                                    before * static_cast<double>(mean_.texels[i])) /
                                   samples_);
        mean_ = std::move(mean);
    }
    static double changeOf(const Image& before, const Image& now, std::size_t i) {
        return static_cast<double>(now.texels[i]) - static_cast<double>(before.texels[i]);
    }

    Beginning beginning_;
    std::uint32_t samples_;
    std::unique_ptr<Oidn> oidn_;
    std::unique_ptr<Renderer> renderer_;
    TemporalMode result_;
    Image picture_, previous_;
    Image mean_;                   ///< of the frames since the camera rests
    std::vector<double> squares_;  ///< relative ones of the picture's pixels
    RunningStatistics flicker_, ghost_;
};

/// Beside which a camera's motion from frame to frame is little.
bool lightChanged(const Truth& before, const Truth& now) {
    return std::abs(now.light - before.light) > kChangeOfLight * before.light;
}

double meanOf(const std::vector<TemporalFrame>& frames, double TemporalFrame::*member) {
    double sum = 0.0;
    for (const TemporalFrame& frame : frames) sum += frame.*member;
    return frames.empty() ? 0.0 : sum / static_cast<double>(frames.size());
}

}  // namespace

double TemporalMode::relMse() const {
    return meanOf(frames, &TemporalFrame::rel_mse);
}

double TemporalMode::flip() const {
    return meanOf(frames, &TemporalFrame::flip);
}

double TemporalMode::seconds() const {
    return meanOf(frames, &TemporalFrame::seconds);
}

TemporalAccuracy measureTemporal(gpu::Device& device, const Scene& scene, std::span<const PathFrame> path,
                                 const RenderSettings& asked, const TemporalRequest& request,
                                 const TemporalHooks& hooks) {
    RenderSettings settings = asked;
    settings.scene_moves = path.front().scene != nullptr;
    requireMemory(kFlipAsDisplayedBytesPerPixel * settings.size.x * settings.size.y, "FLIP takes");
    const Beginning beginning{device, scene, path.front().camera, settings};
    Truths truths(device, scene, beginning.camera, settings, request.reference_samples);
    std::vector<Runner> runners;
    std::vector<Runner> fresh;  // of those that keep a history
    for (const Denoise mode : kTemporalModes) {
        runners.emplace_back(beginning, mode, request.samples);
        if (mode != Denoise::none) fresh.emplace_back(beginning, mode, request.samples);
    }
    if (offersOidn()) runners.emplace_back(beginning, Denoise::oidn, request.samples);
    std::uint32_t sample = settings.first_sample;  // the frame's first; they count on from frame to frame
    TemporalAccuracy result;
    std::optional<Truth> before;
    SurfaceAges ages;
    FreshStarts starts;
    for (std::size_t frame = 0; frame < path.size(); ++frame) {
        const Truth* truth = truths.of(path[frame], hooks.interrupted);
        if (truth == nullptr || (hooks.interrupted && hooks.interrupted())) break;
        result.reference_rel_mse += truth->rel_mse;
        const bool follows = before && path[frame].change == ViewChange::motion;
        ages.advance(follows ? std::optional<SeenDepths>({before->view, before->depth}) : std::nullopt,
                     {truth->view, truth->depth});
        if (before) {
            const std::span<const std::uint32_t> now = ages.ages();
            starts.advance(!follows, lightChanged(*before, *truth),
                           std::find(now.begin(), now.end(), 0U) != now.end());
        }
        sample = follows ? sample + request.samples : settings.first_sample;
        for (Runner& runner : runners) {
            runner.draw(path[frame]);
            runner.compare(*truth);
            if (!follows) continue;
            runner.addFlicker(before->mean, truth->mean);
            runner.addGhost(runners.front().squares(), ages.ages());
        }
        for (std::size_t i = 0; starts.watches() && i < fresh.size(); ++i) {
            // The same samples from here on, so that what is rare is in both.
            if (starts.begins()) fresh[i].beginAnew(sample);
            fresh[i].draw(path[frame]);
            fresh[i].compare(*truth);
            runners[i + 1].addRecovery(starts, fresh[i].squares(), *truth, ages.ages());
        }
        before = *truth;
        result.frames = frame + 1;
        if (hooks.progress) hooks.progress(result.frames, path.size());
    }
    for (const Runner& runner : runners) result.modes.push_back(runner.result());
    if (result.frames > 0) result.reference_rel_mse /= static_cast<double>(result.frames);
    return result;
}

}  // namespace licht
