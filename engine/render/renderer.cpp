#include "licht/render/renderer.h"

#include <array>
#include <cassert>
#include <cmath>
#include <cstring>
#include <optional>

#include "licht/core/clock.h"
#include "licht/core/error.h"
#include "licht/film/develop.h"
#include "licht/gpu/lanes.h"
#include "licht/gpu/upload_image.h"
#include "licht/on_device/gpu_scene.h"
#include "licht/render/adaptive_rounds.h"
#include "licht/render/gbuffer.h"
#include "licht/render/history.h"
#include "licht/render/order_sums.h"
#include "licht/render/programs.h"
#include "licht/render/queues.h"
#include "licht/render/view.h"
#include "licht/settings/settings_table.h"
#include "licht/shared/constants.h"
#include "licht/shared/counters.h"
#include "licht/shared/effects.h"
#include "licht/shared/frame.h"
#include "licht/shared/material.h"

namespace licht {
namespace {

// A submission that runs longer than this meets the watchdogs of desktop systems (about two seconds) on a
// slow moment.
constexpr double kSliceSeconds = 0.1;

// Means over this many samples are as good as exact for the layers, and their plain fp32 sums cannot stall.
constexpr std::uint32_t kMostLayerSamples = 4096;

Effects effectsOf(const Scene& scene, const RenderSettings& settings) {
    Effects effects = settings.all_effects ? allEffects() : detectEffects(scene);
    if (settings.flatten_instances) {
        effects.on[kEffectInstances] = false;
        effects.evidence[kEffectInstances].clear();
    }
    return effects;
}

// How many paths a thread follows, one after the other. On a CPU lanes run in lockstep and there are few of
// them: the next path fills a lane whose path has ended (measured on lavapipe: 1.2 times the samples where
// paths are of different lengths). A GPU wants threads. Some drivers end a thread's loops after 65,535
// rounds. A vertex of a path takes some dozens, and roulette leaves few paths that go on for long; half of
// the rounds are kept in reserve, and a walk that is cut all the same is reported.
std::uint32_t pathsPerThread(const gpu::Device& device, const RenderSettings& settings) {
    constexpr std::uint32_t kMostPaths = 16;
    constexpr std::uint32_t kRounds = 32'768;
    constexpr std::uint32_t kRoundsPerVertex = 125;
    constexpr std::uint32_t kBouncesInRoulette = 16;
    if (settings.paths_per_thread > 0) return settings.paths_per_thread;
    if (!runsInLockstep(device)) return 1;
    const std::uint32_t roulette = std::min(settings.roulette_start, settings.bounces);
    const std::uint32_t vertices = std::min(settings.bounces, roulette + kBouncesInRoulette) + 1;
    return std::clamp(kRounds / kRoundsPerVertex / vertices, 1U, kMostPaths);
}

gpu::SpecConstants constantsOf(const GpuScene& scene, const RenderSettings& settings,
                               std::uint32_t paths_per_thread) {
    gpu::SpecConstants constants = scene.constants();
    constants.merge(programConstants(settings));
    constants[kConstantBlueBits] = settings.blue_bits;
    constants[kConstantOrders] = settings.orders ? settings.bounces + 1U : 0U;
    constants[kConstantPathsPerThread] = paths_per_thread;
    if (settings.all_effects) {
        constants[kConstantTexturePages] = kTexturePages;
        constants[kConstantTextureSlotKinds] = 0xffffffffU;
        constants[kConstantWideTexels] = 1U;
    }
    return constants;
}

// One of the two submissions in flight.
struct Slot {
    Slot(gpu::Device& device, const char* name)
        : commands(device),
          counters(device, name, sizeof(CounterRecord), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                   gpu::Memory::host_read) {
        std::memset(counters.mapped(), 0, sizeof(CounterRecord));
    }
    gpu::Commands commands;
    gpu::Buffer counters;
    gpu::Bindings path;
};

}  // namespace

struct Renderer::State {
    State(gpu::Device& d, const Scene& scene, const Camera& c, const RenderSettings& s)
        : device(d),
          settings(s),
          paths_per_thread(pathsPerThread(d, s)),
          camera(c),
          effects(effectsOf(scene, s)),
          upload_start(Clock::now()),
          gpu_scene(d, scene, effects,
                    {s.direct, s.storage_buffers, s.bvh_quality, s.lights, s.environment_sampling}),
          frame_buffer(d, "frame", sizeof(FrameRecord), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                       gpu::Memory::host_write),
          slots{Slot(d, "counters 0"), Slot(d, "counters 1")} {
        statistics.bvh_seconds = gpu_scene.bvhSeconds();
        statistics.geometry_bytes = gpu_scene.geometryBytes();
        statistics.upload_seconds = secondsSince(upload_start) - statistics.bvh_seconds;
        const Clock::time_point start = Clock::now();
        programs.emplace(device, constantsOf(gpu_scene, settings, paths_per_thread), settings.aovs.any());
        resize(settings.size);
        runEveryProgramOnce();
        statistics.pipeline_seconds = secondsSince(start);
    }

    void runEveryProgramOnce();
    void recordSamples(gpu::Commands& commands, std::size_t slot, const SamplePush& push);
    void recordAccumulate(gpu::Commands& commands, const SamplePush& push) {
        commands.dispatch("accumulate", {programs->accumulate, accumulate_bindings}, push, wholePicture());
    }
    void recordLayers(gpu::Commands& commands, const SamplePush& push) {
        commands.dispatch("layers", {programs->layers, layer_bindings}, push, wholePicture());
    }
    gpu::Threads wholePicture() const { return {settings.size.x, settings.size.y}; }

    void resize(uvec2 size);
    void writeFrame(const ViewRecord& view, const ViewRecord& previous);
    Slot& nextSlot();
    void collect(Slot& slot);
    void foldOrders();
    std::uint32_t rowsPerSlice() const;

    gpu::Device& device;
    RenderSettings settings;
    std::uint32_t paths_per_thread;
    Camera camera;
    Effects effects;
    Clock::time_point upload_start;
    GpuScene gpu_scene;
    gpu::Buffer frame_buffer;
    std::optional<Programs> programs;
    std::optional<Queues> queues;
    std::array<Slot, 2> slots;
    std::size_t next_slot = 0;
    std::optional<History> history;
    std::optional<OrderSums> order_sums;
    std::uint32_t folded_samples = 0;  ///< of the history, into order_sums
    std::optional<AdaptiveRounds> rounds;
    gpu::Bindings gbuffer_bindings, accumulate_bindings, layer_bindings, tonemap_bindings, folded_bindings;
    gpu::Image folded_mean;  ///< of all rounds, for the display
    ViewRecord view{};
    RenderStatistics statistics;
};

void Renderer::State::recordSamples(gpu::Commands& commands, std::size_t slot, const SamplePush& push) {
    if (queues) {
        queues->record(commands, settings.size.x, settings.orders, slot, push);
    } else {
        commands.dispatch("path", {programs->path, slots[slot].path}, push,
                          {settings.size.x, (push.row_count + paths_per_thread - 1) / paths_per_thread});
    }
}

// Some drivers compile at first use. Done here, on one row of the picture, so that compiling is told from
// rendering; nothing of it is kept.
void Renderer::State::runEveryProgramOnce() {
    SamplePush push{};
    push.row_count = 1;
    gpu::Commands commands(device);
    commands.begin();
    recordGbuffer(commands, {programs->gbuffer, gbuffer_bindings}, gpu_scene, *history, push);
    recordSamples(commands, 0, push);
    recordAccumulate(commands, push);
    if (settings.aovs.any()) recordLayers(commands, push);
    commands.dispatch("tonemap", {programs->tonemap, tonemap_bindings}, TonemapPush{}, wholePicture());
    commands.submit();
    commands.wait();
    std::memset(slots[0].counters.mapped(), 0, sizeof(CounterRecord));
    if (order_sums) order_sums->restart();
}

void Renderer::State::resize(uvec2 size) {
    settings.size = size;
    history.reset();
    history.emplace(device, size, settings.aovs.any());
    order_sums.reset();
    folded_samples = 0;
    if (settings.orders || settings.clamp > 0.0F) {
        order_sums.emplace(device, size, settings.orders ? settings.bounces + 1U : 0U, settings.clamp > 0.0F);
        history->order_sums = &order_sums->image();
    }
    rounds.reset();
    if (settings.adaptive) rounds.emplace(device, size, settings.first_sample);
    std::vector<gpu::BoundResource> resources = gpu_scene.resources();
    for (const gpu::BoundResource& r : history->resources()) resources.push_back(r);
    resources.push_back({"FrameBlock", &frame_buffer});
    resources.push_back({"AdaptiveTiles", rounds ? &rounds->records() : &frame_buffer});
    gbuffer_bindings = gpu::Bindings(device, programs->gbuffer, resources);
    accumulate_bindings = gpu::Bindings(device, programs->accumulate, resources);
    tonemap_bindings = gpu::Bindings(device, programs->tonemap, resources);
    if (settings.aovs.any()) layer_bindings = gpu::Bindings(device, programs->layers, resources);
    if (settings.queues) {
        queues.emplace(device, constantsOf(gpu_scene, settings, paths_per_thread), size, settings.bounces,
                       settings.rays_per_thread);
        const std::array counters{static_cast<const gpu::Buffer*>(&slots[0].counters),
                                  static_cast<const gpu::Buffer*>(&slots[1].counters)};
        queues->bind(device, resources, counters);
    }
    for (Slot& slot : slots) {
        std::vector<gpu::BoundResource> with_counters = resources;
        with_counters.push_back({"Counters", &slot.counters});
        slot.path = gpu::Bindings(device, programs->path, with_counters);
    }
    view = makeView(camera, size, gpu_scene.bounds());
    writeFrame(view, view);
}

void Renderer::State::writeFrame(const ViewRecord& now, const ViewRecord& previous) {
    FrameRecord frame{};
    frame.view = now;
    frame.previous_view = previous;
    frame.bounces = settings.bounces;
    frame.roulette_start = settings.roulette_start;
    frame.seed = settings.seed;
    frame.clamp_limit = settings.clamp;
    gpu_scene.describe(frame);
    std::memcpy(frame_buffer.mapped(), &frame, sizeof(frame));
}

void Renderer::State::collect(Slot& slot) {
    slot.commands.wait();
    CounterRecord counts;
    std::memcpy(&counts, slot.counters.mapped(), sizeof(counts));
    std::memset(slot.counters.mapped(), 0, sizeof(counts));
    statistics.bounce_rays += counts.bounce_rays;
    statistics.shadow_rays += counts.shadow_rays;
    statistics.nonfinite_samples += counts.nonfinite_samples;
    statistics.cut_walks += counts.cut_walks;
    statistics.environment_samples += counts.environment_samples;
    statistics.environment_tries += counts.environment_tries;
}

Slot& Renderer::State::nextSlot() {
    Slot& slot = slots[next_slot];
    next_slot = 1 - next_slot;
    collect(slot);
    slot.commands.begin();
    return slot;
}

// Work is sliced by measured time. The picture does not depend on it: a sample is a function of its address
// alone.
std::uint32_t Renderer::State::rowsPerSlice() const {
    double seconds = 0.0;
    for (const Slot& slot : slots) {
        for (const auto& [pass, time] : slot.commands.times())
            if (pass.starts_with("path")) seconds += time.seconds;
    }
    const double rows_done = static_cast<double>(statistics.primary_rays) / settings.size.x;
    const std::uint32_t most_rows = queues ? std::min(queues->mostRows(), settings.size.y) : settings.size.y;
    if (seconds <= 0.0 || rows_done <= 0.0) return std::min(most_rows, 128U);
    const double rows =
        std::clamp(kSliceSeconds * rows_done / seconds, 8.0, std::max(8.0, static_cast<double>(most_rows)));
    return static_cast<std::uint32_t>(rows);
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
    SamplePush push{};
    push.sample_index =
        s.settings.first_sample + (s.rounds ? s.rounds->firstFrame() : 0U) + s.history->samples;
    if (push.sample_index < s.settings.first_sample || s.history->samples == 0xffffffffU)
        throw InputError("the samples of a pixel are numbered by 32 bits, and all of them are used");
    push.count_before = s.history->samples;
    const std::uint32_t rows = s.rowsPerSlice();
    for (push.first_row = 0; push.first_row < s.settings.size.y; push.first_row += rows) {
        push.row_count = std::min(rows, s.settings.size.y - push.first_row);
        Slot& slot = s.nextSlot();
        if (push.first_row == 0)
            recordGbuffer(slot.commands, {s.programs->gbuffer, s.gbuffer_bindings}, s.gpu_scene, *s.history,
                          push);
        s.recordSamples(slot.commands, static_cast<std::size_t>(&slot - s.slots.data()), push);
        if (push.first_row + push.row_count == s.settings.size.y) {
            s.recordAccumulate(slot.commands, push);
            if (s.settings.aovs.any() && push.count_before < kMostLayerSamples) {
                s.recordLayers(slot.commands, push);
                ++s.history->aov_samples;
            }
        }
        const gpu::Buffer* counters = &slot.counters;
        slot.commands.makeVisibleToHost(std::span(&counters, 1));
        slot.commands.submit();
    }
    ++s.history->samples;
    s.statistics.primary_rays += std::uint64_t{s.settings.size.x} * s.settings.size.y;
    if (s.order_sums && !s.rounds && OrderSums::due(s.history->samples, s.folded_samples)) {
        finish();
        s.foldOrders();
    }
}

void Renderer::State::foldOrders() {
    if (folded_samples == history->samples) return;
    order_sums->fold(history->samples - folded_samples);
    folded_samples = history->samples;
}

void Renderer::beginRound(std::uint32_t samples) {
    State& s = *state_;
    assert(s.rounds && samples > 0);
    finish();
    s.rounds->begin(samples);
    s.history->samples = 0;
    s.history->aov_samples = 0;  // the layers are those of the last round's frames
}

bool Renderer::roundDone() const {
    return state_->history->samples == state_->rounds->frames();
}

void Renderer::endRound() {
    State& s = *state_;
    finish();
    s.rounds->end(s.history->samples, gpu::readImage(s.device, s.history->mean_high),
                  gpu::readImage(s.device, s.history->squares_high));
    if (s.order_sums) s.order_sums->fold(s.rounds->budget(), s.rounds->pixelCounts());
    s.history->samples = 0;
}

void Renderer::finish() {
    for (Slot& slot : state_->slots) state_->collect(slot);
}

std::uint32_t Renderer::samples() const {
    const State& s = *state_;
    return s.rounds ? static_cast<std::uint32_t>(s.rounds->samples(s.history->samples)) : s.history->samples;
}

void Renderer::setCamera(const Camera& camera) {
    State& s = *state_;
    const ViewRecord view = makeView(camera, s.settings.size, s.gpu_scene.bounds());
    s.camera = camera;
    if (std::memcmp(&view, &s.view, sizeof(view)) == 0) return;
    finish();
    s.writeFrame(view, s.view);
    s.view = view;
    s.history->samples = 0;
    s.history->aov_samples = 0;
    s.folded_samples = 0;
    if (s.order_sums) s.order_sums->restart();
    if (s.rounds) s.rounds->restart();
}

void Renderer::resize(uvec2 size) {
    finish();
    state_->resize(size);
}

Film Renderer::readFilm() {
    State& s = *state_;
    finish();
    Film film;
    if (s.rounds ? s.rounds->film().samples() == 0 : s.history->samples == 0)
        throw DeviceError("no sample has been rendered yet");
    if (s.rounds) {
        film = s.rounds->film().film();
    } else {
        film.size = s.settings.size;
        film.samples = s.history->samples;
        developBeauty(film, gpu::readImage(s.device, s.history->mean_high),
                      gpu::readImage(s.device, s.history->squares_high));
        if (s.order_sums) s.foldOrders();
    }
    if (s.order_sums) s.order_sums->develop(film);
    if (s.settings.aovs.any())
        developLayers(
            film, s.settings.aovs, s.history->aov_samples, gpu::readImage(s.device, s.history->aov_albedo),
            gpu::readImage(s.device, s.history->aov_normal), gpu::readImage(s.device, s.history->aov_motion));
    return film;
}

void Renderer::recordDisplay(gpu::Commands& commands, Tonemap curve, float exposure_ev) {
    State& s = *state_;
    TonemapPush push{};
    push.exposure = std::exp2(exposure_ev);
    push.curve = static_cast<uint>(curve);
    if (!s.rounds) {
        commands.dispatch("tonemap", {s.programs->tonemap, s.tonemap_bindings}, push, s.wholePicture());
        return;
    }
    // The history holds the last round alone.
    const Film film = s.rounds->film().film();
    s.folded_mean = gpu::uploadImage(
        s.device, "folded mean", {film.size.x, film.size.y}, VK_FORMAT_R32G32B32A32_SFLOAT,
        std::as_bytes(std::span(film.mean.texels)), VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT);
    s.folded_bindings =
        gpu::Bindings(s.device, s.programs->tonemap,
                      std::array<gpu::BoundResource, 2>{
                          {{"mean_high", &s.folded_mean}, {"display_image", &s.history->display}}});
    commands.dispatch("tonemap", {s.programs->tonemap, s.folded_bindings}, push, s.wholePicture());
}

Image Renderer::readDisplay(Tonemap curve, float exposure_ev) {
    State& s = *state_;
    finish();
    gpu::Commands commands(s.device);
    commands.begin();
    recordDisplay(commands, curve, exposure_ev);
    commands.submit();
    commands.wait();
    for (const auto& [name, time] : commands.times()) {
        s.statistics.passes[name].seconds += time.seconds;
        s.statistics.passes[name].count += time.count;
    }
    const std::vector<std::byte> bytes = gpu::readImage(s.device, s.history->display);
    Image picture(static_cast<int>(s.settings.size.x), static_cast<int>(s.settings.size.y), 4);
    for (std::size_t i = 0; i < picture.texels.size(); ++i)
        picture.texels[i] = static_cast<float>(bytes[i]) / 255.0F;
    return picture;
}

const gpu::Image& Renderer::displayImage() const {
    return state_->history->display;
}

std::vector<LightBatch> Renderer::lightBatches() const {
    return state_->order_sums ? state_->order_sums->batches() : std::vector<LightBatch>{};
}

const Effects& Renderer::effects() const {
    return state_->effects;
}

RenderStatistics Renderer::statistics() const {
    RenderStatistics result = state_->statistics;
    if (state_->order_sums) result.order_rays = state_->order_sums->rays();
    for (const Slot& slot : state_->slots) {
        for (const auto& [name, time] : slot.commands.times()) {
            result.passes[name].seconds += time.seconds;
            result.passes[name].count += time.count;
        }
    }
    return result;
}

}  // namespace licht
