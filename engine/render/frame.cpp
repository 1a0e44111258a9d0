#include "licht/render/frame.h"

#include <algorithm>
#include <array>

#include "licht/render/gbuffer.h"
#include "licht/render/pass_list.h"

namespace licht {
namespace {

// Means over this many samples are as good as exact for the layers, and their plain fp32 sums cannot stall.
constexpr std::uint32_t kMostLayerSamples = 4096;

}  // namespace

Frame::Frame(gpu::Device& device, const Programs& programs, const GpuScene& scene,
             const RenderSettings& settings, const InFlight& in_flight, const gpu::Image* order_sums,
             const gpu::Buffer* tiles)
    : programs_(programs), scene_(scene), settings_(settings), images_(device, settings.size, settings) {
    if (order_sums != nullptr) images_.lend("order_sums", *order_sums);
    if (programs.wavefront) wavefront_.emplace(device, *programs.wavefront, settings.size);
    for (std::size_t slot = 0; slot < InFlight::kSlots; ++slot) {
        for (std::size_t parity = 0; parity < images_.parities(); ++parity) {
            std::vector<gpu::BoundResource> resources = scene.resources();
            for (const gpu::BoundResource& image : images_.resources(parity)) resources.push_back(image);
            resources.push_back({"FrameBlock", &in_flight[slot].record});
            resources.push_back({"Counters", &in_flight[slot].counters});
            resources.push_back({"AdaptiveTiles", tiles != nullptr ? tiles : &in_flight[slot].record});
            const auto to = [&](const gpu::Program& program) {
                return gpu::Bindings(device, program, resources);
            };
            Bound& bound = bound_.emplace_back();
            bound.gbuffer = to(programs.gbuffer);
            bound.accumulate = to(programs.accumulate);
            if (settings.layers.anyDrawn()) bound.layers = to(programs.layers);
            if (programs.filter) bound.signals = to(programs.filter->signals);
            if (programs.history) {
                bound.reproject = to(programs.history->reproject);
                bound.edges = to(programs.history->edges);
                bound.parts = to(programs.history->parts);
            }
            if (slot == 0) tonemap_.push_back(to(programs.tonemap));
            if (wavefront_)
                wavefront_->bind(std::move(resources));
            else
                bound.path = to(programs.path);
        }
    }
    if (!programs.filter) return;
    filter_.emplace(device, *programs.filter, images_, settings);
    if (programs.history) {
        const std::vector<gpu::BoundResource> images = images_.resources(images_.parity());
        fold_ = gpu::Bindings(device, programs.history->fold, images);
        resolve_ = gpu::Bindings(device, programs.history->resolve, images);
    }
    const std::array<gpu::BoundResource, 2> shown{
        {{"mean_high", &images_["filtered"]}, {"display_image", &images_["display_image"]}}};
    tonemap_filtered_ = gpu::Bindings(device, programs.tonemap, shown);
}

void Frame::begin() {
    if (begun_) images_.next();
    begun_ = true;
}

void Frame::record(gpu::Commands& commands, std::size_t slot, const Slice& slice) const {
    const std::size_t bound = slot * images_.parities() + images_.parity();
    const Bound& on = bound_[bound];
    if (slice.first) recordGbuffer(commands, {programs_.gbuffer, on.gbuffer}, scene_, images_, slice.push);
    followPaths(commands, bound, slice.push);
    if (!slice.last) return;
    commands.dispatch(passName(PassId::accumulate), {programs_.accumulate, on.accumulate}, slice.push,
                      pixels());
    if (programs_.filter)
        commands.dispatch(passName(PassId::signals), {programs_.filter->signals, on.signals}, slice.push,
                          pixels());
    if (drawsLayers(slice.push.count_before))
        commands.dispatch(passName(PassId::layers), {programs_.layers, on.layers}, slice.push, pixels());
}

void Frame::recordFold(gpu::Commands& commands, const HalfCounts& counts) const {
    commands.dispatch(passName(PassId::history_fold), {programs_.history->fold, fold_},
                      filterPush(images_.size(), counts, false), pixels());
}

void Frame::recordReproject(gpu::Commands& commands, std::size_t slot, const ReprojectPush& push) const {
    const Bound& on = bound_[slot * images_.parities() + images_.parity()];
    commands.dispatch(passName(PassId::history_reproject), {programs_.history->reproject, on.reproject}, push,
                      pixels());
    commands.dispatch(passName(PassId::history_edges), {programs_.history->edges, on.edges}, push, pixels());
    commands.dispatch(passName(PassId::history_parts), {programs_.history->parts, on.parts}, push,
                      {pixels().x * kEdgeParts, pixels().y});
}

void Frame::followPaths(gpu::Commands& commands, std::size_t bound, const SamplePush& push) const {
    if (wavefront_) {
        wavefront_->record(commands, bound, settings_.orders, push);
        return;
    }
    const std::uint32_t rows = (push.row_count + programs_.paths_per_thread - 1) / programs_.paths_per_thread;
    commands.dispatch(passName(PassId::path), {programs_.path, bound_[bound].path}, push,
                      {images_.size().x, rows});
}

void Frame::recordFilter(gpu::Commands& commands, const HalfCounts& counts, bool orthographic) const {
    filter_->record(commands, counts, orthographic);
    if (programs_.history)
        commands.dispatch(passName(PassId::filter_resolve), {programs_.history->resolve, resolve_},
                          filterPush(images_.size(), counts, orthographic), pixels());
}

void Frame::recordDisplay(gpu::Commands& commands, const TonemapPush& push, bool filtered) const {
    const gpu::Bindings& shown = filtered ? tonemap_filtered_ : tonemap_[images_.parity()];
    commands.dispatch(passName(PassId::tonemap), {programs_.tonemap, shown}, push, pixels());
}

bool Frame::drawsLayers(std::uint32_t count_before) const {
    return settings_.layers.anyDrawn() && count_before < kMostLayerSamples;
}

std::uint32_t Frame::mostRows() const {
    return wavefront_ ? std::min(wavefront_->mostRows(), images_.size().y) : images_.size().y;
}

}  // namespace licht
