#include "licht/render/renderer.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <optional>

#include "licht/core/clock.h"
#include "licht/core/error.h"
#include "licht/film/develop.h"
#include "licht/render/adaptive_rounds.h"
#include "licht/render/display.h"
#include "licht/render/frame.h"
#include "licht/render/images.h"
#include "licht/render/in_flight.h"
#include "licht/render/order_sums.h"
#include "licht/render/pass_list.h"
#include "licht/render/preparation.h"
#include "licht/render/programs.h"
#include "licht/render/scene_on_device.h"
#include "licht/render/slices.h"
#include "licht/render/view.h"
#include "licht/shared/frame.h"

namespace licht {
struct Renderer::State {
    State(gpu::Device& d, const Scene& first, const Camera& c, const RenderSettings& s)
        : device(withRoom(d, s)),
          settings(s),
          camera(c),
          upload_start(Clock::now()),
          scene(d, first, effectsOf(first, s), settings),
          in_flight(d) {
        assert(settings.denoise != Denoise::oidn);  // the host's, behind all this
        statistics.bvh_seconds = scene.now().bvhSeconds();
        statistics.geometry_bytes = scene.now().geometryBytes();
        statistics.upload_seconds = secondsSince(upload_start) - statistics.bvh_seconds;
        const Clock::time_point start = Clock::now();
        programs.emplace(device, programConstants(scene, settings), settings);
        resize(settings.size);
        runEveryProgramOnce();
        statistics.pipeline_seconds = secondsSince(start);
    }

    void runEveryProgramOnce();
    void resize(uvec2 size);
    /// Nothing that was seen counts any longer.
    void restart();
    /// What was seen may count for what is seen next, whose samples are others.
    void changeView();
    void forgetSamples();
    /// What a new view's first sample does beside the others: before its passes, and behind them.
    void recordBefore(gpu::Commands& commands, std::size_t slot);
    void recordBehind(gpu::Commands& commands, std::size_t slot, std::uint32_t sample_index);
    void foldOrders();
    [[nodiscard]] bool filters() const { return keepsSignals(settings); }
    /// Index of the first sample of the present view.
    [[nodiscard]] std::uint32_t firstSample() const { return settings.first_sample + earlier_samples; }
    /// Unless it is done for these samples.
    void recordFilter(gpu::Commands& commands);
    void readFiltered(Film& film);
    [[nodiscard]] FrameRecord frameRecord() const;
    [[nodiscard]] std::uint32_t rowsPerSlice() const;
    [[nodiscard]] std::vector<std::byte> read(std::string_view image) const {
        return gpu::readImage(device, frame->images()[image]);
    }

    gpu::Device& device;
    RenderSettings settings;
    Camera camera;
    Clock::time_point upload_start;
    SceneOnDevice scene;
    InFlight in_flight;
    std::optional<Programs> programs;
    std::optional<OrderSums> order_sums;
    std::optional<AdaptiveRounds> rounds;
    std::optional<Frame> frame;
    std::uint32_t samples = 0;           ///< in the history
    std::uint32_t layer_samples = 0;     ///< in the layers
    std::uint32_t filtered_samples = 0;  ///< of the history, that "filtered" is made of
    std::uint32_t folded_samples = 0;    ///< of the history, into order_sums
    std::uint32_t earlier_samples = 0;   ///< of views before this one, since the last cut
    bool fresh = true;                   ///< there is none that this one is told of
    bool changed = false;                ///< the scene is another than that of the view before
    std::optional<HalfCounts> untold;    ///< samples of the view before that "history" does not hold yet
    HostPicture on_host;                 ///< for the display
    ViewRecord view{};
    ViewRecord previous_view{};   ///< that the last sample saw
    RenderStatistics statistics;  ///< without what in_flight counts
};

// Some drivers compile at first use. Done here, on one row of the picture, so that compiling is told from
// rendering; nothing of it is kept.
void Renderer::State::runEveryProgramOnce() {
    Slice slice;
    slice.push.row_count = 1;
    in_flight.runAside(device, frameRecord(), [&](gpu::Commands& commands, std::size_t slot) {
        frame->record(commands, slot, slice);
        frame->recordDisplay(commands, TonemapPush{});
        if (keepsHistory(settings)) {
            if (settings.scene_moves) frame->recordGradients(commands, slot, 0);
            frame->recordFold(commands, {1, 1});
            frame->recordReproject(commands, slot, {0, 1, 0});
        }
        if (keepsSignals(settings)) frame->recordFilter(commands, {1, 1}, false);
    });
    if (order_sums) order_sums->restart();
}

// Programs stay; what depends on the size is made anew.
void Renderer::State::resize(uvec2 size) {
    settings.size = size;
    frame.reset();
    order_sums.reset();
    rounds.reset();
    if (settings.orders || settings.clamp > 0.0F)
        order_sums.emplace(device, size, settings.orders ? settings.bounces + 1U : 0U, settings.clamp > 0.0F);
    if (settings.adaptive) rounds.emplace(device, size, settings.first_sample);
    frame.emplace(device, *programs, scene, settings, in_flight, order_sums ? &order_sums->image() : nullptr,
                  rounds ? &rounds->records() : nullptr);
    restart();
    view = makeView(camera, size, scene.now().bounds());
    previous_view = view;
}

FrameRecord Renderer::State::frameRecord() const {
    FrameRecord record{};
    record.view = view;
    record.previous_view = previous_view;
    record.bounces = settings.bounces;
    record.roulette_start = settings.roulette_start;
    record.seed = settings.seed;
    record.clamp_limit = settings.clamp;
    scene.now().describe(record);
    return record;
}

std::uint32_t Renderer::State::rowsPerSlice() const {
    const double rows_done = static_cast<double>(statistics.primary_rays) / settings.size.x;
    return licht::rowsPerSlice(in_flight.pathSeconds(), rows_done, frame->mostRows());
}

Renderer::Renderer(gpu::Device& device, const Scene& scene, const Camera& camera,
                   const RenderSettings& settings)
    : state_(std::make_unique<State>(device, scene, camera, settings)) {}

Renderer::~Renderer() {
    // Nothing may die while the device still reads it; a lost device reads nothing.
    try {
        finish();
    } catch (const DeviceError&) {
        return;
    }
}

void Renderer::renderSample() {
    State& s = *state_;
    Slice slice;
    SamplePush& push = slice.push;
    push.sample_index = s.firstSample() + (s.rounds ? s.rounds->firstFrame() : 0U) + s.samples;
    if (push.sample_index < s.settings.first_sample || s.samples == 0xffffffffU)
        throw InputError("the samples of a pixel are numbered by 32 bits, and all of them are used");
    push.count_before = s.samples;
    const std::uint32_t rows = s.rowsPerSlice();
    const FrameRecord record = s.frameRecord();
    s.frame->begin();
    for (push.first_row = 0; push.first_row < s.settings.size.y; push.first_row += rows) {
        push.row_count = std::min(rows, s.settings.size.y - push.first_row);
        slice.first = push.first_row == 0;
        slice.last = push.first_row + push.row_count == s.settings.size.y;
        const std::size_t slot = s.in_flight.begin(record);
        if (slice.first) s.recordBefore(s.in_flight.commands(slot), slot);
        s.frame->record(s.in_flight.commands(slot), slot, slice);
        if (slice.last) s.recordBehind(s.in_flight.commands(slot), slot, push.sample_index);
        s.in_flight.submit(slot);
    }
    if (s.frame->drawsLayers(push.count_before)) ++s.layer_samples;
    s.previous_view = s.view;
    ++s.samples;
    s.statistics.primary_rays += std::uint64_t{s.settings.size.x} * s.settings.size.y;
    if (s.order_sums && !s.rounds && OrderSums::due(s.samples, s.folded_samples)) {
        finish();
        s.foldOrders();
    }
}

void Renderer::State::recordBefore(gpu::Commands& commands, std::size_t slot) {
    if (!untold) return;
    if (changed) frame->recordGradients(commands, slot, firstSample() - 1);
    frame->recordFold(commands, *untold);
    untold.reset();
}

void Renderer::State::recordBehind(gpu::Commands& commands, std::size_t slot, std::uint32_t sample_index) {
    if (!keepsHistory(settings) || samples > 0) return;
    frame->recordReproject(commands, slot, {sample_index, fresh ? 1U : 0U, changed ? 1U : 0U});
    fresh = false;
    changed = false;
}

void Renderer::State::foldOrders() {
    if (folded_samples == samples) return;
    order_sums->fold(samples - folded_samples);
    folded_samples = samples;
}

void Renderer::State::recordFilter(gpu::Commands& commands) {
    if (filtered_samples == samples) return;
    filtered_samples = samples;
    frame->recordFilter(commands, halvesOf(firstSample(), samples), view.orthographic != 0);
}

void Renderer::State::readFiltered(Film& film) {
    gpu::Commands commands(device);
    commands.begin();
    recordFilter(commands);
    commands.submit();
    commands.wait();
    addTimes(statistics.passes, commands.times());
    developFiltered(film, read("filtered"), read("filtered_error"));
}

void Renderer::beginRound(std::uint32_t samples) {
    State& s = *state_;
    assert(s.rounds && samples > 0);
    finish();
    s.rounds->begin(samples);
    s.samples = 0;
    s.layer_samples = 0;  // the layers are those of the last round's frames
}

bool Renderer::roundDone() const {
    return state_->samples == state_->rounds->frames();
}

void Renderer::endRound() {
    State& s = *state_;
    finish();
    s.rounds->end(s.samples, s.read("mean_high"), s.read("squares_high"));
    if (s.order_sums) s.order_sums->fold(s.rounds->budget(), s.rounds->pixelCounts());
    s.samples = 0;
}

void Renderer::finish() {
    state_->in_flight.finish();
}

std::uint32_t Renderer::samples() const {
    const State& s = *state_;
    return s.rounds ? static_cast<std::uint32_t>(s.rounds->samples(s.samples)) : s.samples;
}

// The history starts anew by itself: its passes see that there are no samples.
void Renderer::State::restart() {
    forgetSamples();
    earlier_samples = 0;
    fresh = true;
    changed = false;
    untold.reset();
}

void Renderer::State::changeView() {
    if (!settings.moves) return restart();
    if (!changed && scene.moved()) {
        in_flight.finish();
        scene.rest();
        frame->bind();
    }
    if (samples > 0 && keepsHistory(settings)) untold = halvesOf(firstSample(), samples);
    earlier_samples += samples;
    forgetSamples();
}

void Renderer::State::forgetSamples() {
    samples = 0;
    layer_samples = 0;
    filtered_samples = 0;
    folded_samples = 0;
    if (!order_sums && !rounds) return;
    in_flight.finish();
    if (order_sums) order_sums->restart();
    if (rounds) rounds->restart();
}

void Renderer::setCamera(const Camera& camera, ViewChange change) {
    State& s = *state_;
    const ViewRecord view = makeView(camera, s.settings.size, s.scene.now().bounds());
    s.camera = camera;
    const bool same = std::memcmp(&view, &s.view, sizeof(view)) == 0;
    s.view = view;
    if (change == ViewChange::cut)
        s.restart();
    else if (!same)
        s.changeView();
}

void Renderer::setScene(const Scene& scene, ViewChange change) {
    State& s = *state_;
    assert(s.settings.scene_moves);
    finish();
    const SceneChange how = s.scene.replace(scene, !s.changed);
    if (how == SceneChange::other) {
        s.programs.emplace(s.device, programConstants(s.scene, s.settings), s.settings);
        s.resize(s.settings.size);
        s.runEveryProgramOnce();
        return;
    }
    s.frame->bind();
    if (change == ViewChange::cut) return s.restart();
    s.changed = !s.fresh;
    s.changeView();
}

void Renderer::resize(uvec2 size) {
    finish();
    state_->resize(size);
}

Film Renderer::readFilm() {
    State& s = *state_;
    finish();
    Film film;
    if (s.rounds ? s.rounds->film().samples() == 0 : s.samples == 0)
        throw DeviceError("no sample has been rendered yet");
    if (s.rounds) {
        film = s.rounds->film().film();
    } else {
        film.size = s.settings.size;
        film.samples = s.samples;
        developBeauty(film, s.read("mean_high"), s.read("squares_high"));
        if (s.filters()) s.readFiltered(film);
        if (s.order_sums) s.foldOrders();
    }
    if (s.order_sums) s.order_sums->develop(film);
    if (s.settings.layers.anyDrawn()) {
        LayerTexels images;
        for (const std::string_view image : layerImages()) images[image] = s.read(image);
        developLayers(film, s.settings.layers, s.layer_samples, images);
    }
    return film;
}

void Renderer::recordDisplay(gpu::Commands& commands, Tonemap curve, float exposure_ev, bool filtered) {
    State& s = *state_;
    const TonemapPush push = displayedBy(curve, exposure_ev);
    if (!s.rounds) {
        filtered = filtered && s.filters();
        if (filtered) s.recordFilter(commands);
        s.frame->recordDisplay(commands, push, filtered);
        return;
    }
    // The history holds the last round alone.
    s.on_host.recordDisplay(s.device, commands, s.programs->tonemap, s.rounds->film().film().mean, push,
                            displayImage());
}

Image Renderer::readDisplay(Tonemap curve, float exposure_ev, bool filtered) {
    State& s = *state_;
    finish();
    return licht::readDisplay(s.device, displayImage(), s.statistics.passes, [&](gpu::Commands& commands) {
        recordDisplay(commands, curve, exposure_ev, filtered);
    });
}

Image Renderer::readDisplay(const Image& picture, Tonemap curve, float exposure_ev) {
    State& s = *state_;
    finish();
    return licht::readDisplay(s.device, displayImage(), s.statistics.passes, [&](gpu::Commands& commands) {
        s.on_host.recordDisplay(s.device, commands, s.programs->tonemap, picture,
                                displayedBy(curve, exposure_ev), displayImage());
    });
}

const gpu::Image& Renderer::displayImage() const {
    return state_->frame->images()["display_image"];
}

std::vector<LightBatch> Renderer::lightBatches() const {
    return state_->order_sums ? state_->order_sums->batches() : std::vector<LightBatch>{};
}

const Effects& Renderer::effects() const {
    return state_->scene.effects();
}

RenderStatistics Renderer::statistics() const {
    RenderStatistics result = state_->statistics;
    if (state_->order_sums) result.order_rays = state_->order_sums->rays();
    state_->in_flight.addTo(result);
    return result;
}

}  // namespace licht
