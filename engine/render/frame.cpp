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

Frame::Frame(gpu::Device& device, const Programs& programs, const SceneOnDevice& scene,
             const RenderSettings& settings, const InFlight& in_flight, const gpu::Image* order_sums,
             const gpu::Buffer* tiles)
    : device_(device),
      programs_(programs),
      scene_(scene),
      settings_(settings),
      in_flight_(in_flight),
      tiles_(tiles),
      images_(device, settings.size, settings) {
    if (order_sums != nullptr) images_.lend("order_sums", *order_sums);
    if (programs.wavefront) wavefront_.emplace(device, *programs.wavefront, settings.size);
    bind();
    const std::vector<gpu::BoundResource> images = images_.resources(0);
    for (std::size_t parity = 0; parity < images_.parities(); ++parity)
        tonemap_.emplace_back(device, programs.tonemap, images_.resources(parity));
    if (!programs.filter) return;
    filter_.emplace(device, *programs.filter, images_, settings);
    const std::array<gpu::BoundResource, 2> shown{
        {{"mean_high", &images_["filtered"]}, {"display_image", &images_["display_image"]}}};
    tonemap_filtered_ = gpu::Bindings(device, programs.tonemap, shown);
    if (!programs.history) return;
    fold_ = gpu::Bindings(device, programs.history->fold, images);
    resolve_ = gpu::Bindings(device, programs.history->resolve, images);
    if (!settings.scene_moves) return;
    const std::array gradients{&images_["gradients_even"], &images_["gradients_odd"]};
    for (std::size_t i = 0; i < spread_.size(); ++i)
        spread_[i] = gpu::Bindings(device, programs.history->spread,
                                   std::array<gpu::BoundResource, 2>{{{"gradients_from", gradients[i]},
                                                                      {"gradients_to", gradients[1 - i]}}});
}

// What a slot's passes read and write.
std::vector<gpu::BoundResource> Frame::resources(std::size_t slot, std::size_t parity) const {
    std::vector<gpu::BoundResource> list = scene_.now().resources();
    for (const gpu::BoundResource& image : images_.resources(parity)) list.push_back(image);
    for (const gpu::BoundResource& before : scene_.before().previousResources()) list.push_back(before);
    list.push_back({"FrameBlock", &in_flight_[slot].record});
    list.push_back({"Counters", &in_flight_[slot].counters});
    list.push_back({"AdaptiveTiles", tiles_ != nullptr ? tiles_ : &in_flight_[slot].record});
    // Gradients are summed an even number of times, so they begin and end in one place.
    list.push_back({"gradients_from", &images_["gradients_even"]});
    list.push_back({"gradients_to", &images_["gradients_even"]});
    return list;
}

void Frame::bind() {
    bound_.clear();
    if (wavefront_) wavefront_->unbind();
    for (std::size_t slot = 0; slot < InFlight::kSlots; ++slot) {
        for (std::size_t parity = 0; parity < images_.parities(); ++parity) {
            std::vector<gpu::BoundResource> list = resources(slot, parity);
            const auto to = [&](const gpu::Program& program) {
                return gpu::Bindings(device_, program, list);
            };
            Bound& bound = bound_.emplace_back();
            bound.gbuffer = to(programs_.gbuffer);
            bound.accumulate = to(programs_.accumulate);
            if (settings_.layers.anyDrawn()) bound.layers = to(programs_.layers);
            if (programs_.filter) bound.signals = to(programs_.filter->signals);
            if (programs_.history) {
                bound.reproject = to(programs_.history->reproject);
                bound.edges = to(programs_.history->edges);
                bound.parts = to(programs_.history->parts);
                if (settings_.scene_moves) bound.gradient = to(programs_.history->gradient);
            }
            if (wavefront_)
                wavefront_->bind(std::move(list));
            else
                bound.path = to(programs_.path);
        }
    }
}

void Frame::begin() {
    if (begun_) images_.next();
    begun_ = true;
}

void Frame::record(gpu::Commands& commands, std::size_t slot, const Slice& slice) const {
    const std::size_t bound = slot * images_.parities() + images_.parity();
    const Bound& on = bound_[bound];
    if (slice.first)
        recordGbuffer(commands, {programs_.gbuffer, on.gbuffer}, scene_.now(), images_, slice.push);
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

void Frame::recordGradients(gpu::Commands& commands, std::size_t slot, std::uint32_t last_sample) const {
    const Bound& on = bound_[slot * images_.parities() + images_.parity()];
    const gpu::Image& gradients = images_["gradients_even"];
    const gpu::Threads squares{gradients.extent().width, gradients.extent().height};
    GradientPush push{last_sample, 1};
    commands.dispatch(passName(PassId::history_gradient), {programs_.history->gradient, on.gradient}, push,
                      squares);
    for (const gpu::Bindings& spread : spread_) {
        commands.dispatch(passName(PassId::history_spread), {programs_.history->spread, spread}, push,
                          squares);
        push.stride *= 2;
    }
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
