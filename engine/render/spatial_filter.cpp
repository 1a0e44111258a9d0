#include "licht/render/spatial_filter.h"

#include <cassert>

#include "licht/render/pass_list.h"
#include "licht/shared/constants.h"
#include "licht/spirv/filter_begin_comp.h"
#include "licht/spirv/filter_bias_comp.h"
#include "licht/spirv/filter_end_comp.h"
#include "licht/spirv/filter_guide_comp.h"
#include "licht/spirv/filter_level_comp.h"
#include "licht/spirv/filter_smooth_comp.h"
#include "licht/spirv/signals_comp.h"

namespace licht {
namespace {

// Strides 1 to 16: 125 taps reach 62 pixels.
constexpr std::uint32_t kLevels = 5;
// Variances of single pixels are noise, and biases are smaller than that: their means are taken over the
// pixels around, with standard deviations of 1.6 and 6.5 pixels.
constexpr std::uint32_t kVarianceSmoothings = 2;
constexpr std::uint32_t kBiasSmoothings = 4;

// Of a pair of images, 0 the even one, where they lie then.
constexpr std::size_t kVariances = kVarianceSmoothings % 2;
constexpr std::size_t kBiases = (1 - kVariances + kBiasSmoothings) % 2;

gpu::SpecConstants with(gpu::SpecConstants constants, std::uint32_t id) {
    constants[id] = 1U;
    return constants;
}

}  // namespace

FilterPrograms::FilterPrograms(gpu::Device& device, const gpu::SpecConstants& constants)
    : signals(gpu::Program::compute(device, "signals", signals_comp, constants)),
      guide(gpu::Program::compute(device, "filter guide", filter_guide_comp, constants)),
      begin(gpu::Program::compute(device, "filter begin", filter_begin_comp, constants)),
      smooth(gpu::Program::compute(device, "filter smooth", filter_smooth_comp, constants)),
      first_level(gpu::Program::compute(device, "filter first level", filter_level_comp,
                                        with(constants, kConstantFirstLevel))),
      level(gpu::Program::compute(device, "filter level", filter_level_comp, constants)),
      bias(gpu::Program::compute(device, "filter bias", filter_bias_comp, constants)),
      end(gpu::Program::compute(device, "filter end", filter_end_comp, constants)) {}

HalfCounts halvesOf(std::uint32_t first_sample, std::uint32_t samples) {
    const std::uint32_t odd = samples / 2 + (samples % 2 != 0 && first_sample % 2 != 0 ? 1U : 0U);
    return {samples - odd, odd};
}

FilterPush filterPush(uvec2 size, const HalfCounts& counts, bool orthographic) {
    FilterPush push{};
    push.size = size;
    push.orthographic = orthographic ? 1U : 0U;
    push.stride = 1;
    push.count_a = static_cast<float>(counts.a);
    push.count_b = static_cast<float>(counts.b);
    return push;
}

SpatialFilter::SpatialFilter(gpu::Device& device, const FilterPrograms& programs, const Images& images,
                             const RenderSettings& settings)
    : programs_(programs), size_(images.size()), spatial_(settings.denoise == Denoise::spatiotemporal) {
    const bool resolved = keepsHistory(settings);
    const auto to = [&](const gpu::Program& program, std::size_t filter_from, std::size_t smooth_from) {
        const std::array filters{&images["filter_even"], &images["filter_odd"]};
        const std::array smooths{&images["smooth_even"], &images["smooth_odd"]};
        const std::array<gpu::BoundResource, 10> resources{
            {{"signal_sums", &images["signal_sums"]},
             {"prior", &images["prior"]},
             {"mean_high", &images["mean_high"]},
             {"filter_guide", &images["filter_guide"]},
             {"filter_from", filters[filter_from]},
             {"filter_to", filters[1 - filter_from]},
             {"smooth_from", smooths[smooth_from]},
             {"smooth_to", smooths[1 - smooth_from]},
             {"filtered", &images[resolved ? "unresolved" : "filtered"]},
             {"filtered_error", &images[resolved ? "unresolved_error" : "filtered_error"]}}};
        return gpu::Bindings(device, program, resources);
    };
    // Each pass takes up where the one before it left off.
    guide_ = to(programs.guide, 0, 0);
    begin_ = to(programs.begin, 1, 1);
    for (std::size_t i = 0; i < 2; ++i) {
        smooth_[i] = to(programs.smooth, 0, i);
        level_[i] = to(programs.level, i, kVariances);
    }
    bias_ = to(programs.bias, kLevels % 2, kVariances);
    end_ = spatial_ ? to(programs.end, kLevels % 2, kBiases) : to(programs.end, 0, kVariances);
}

void SpatialFilter::record(gpu::Commands& commands, const HalfCounts& counts, bool orthographic) const {
    assert(counts.a > 0 || counts.b > 0);
    FilterPush push = filterPush(size_, counts, orthographic);
    const auto pass = [&](PassId id, const gpu::Program& program, const gpu::Bindings& bindings) {
        commands.dispatch(passName(id), {program, bindings}, push, {size_.x, size_.y});
    };
    const auto smooth = [&](std::size_t from, std::uint32_t times) {
        for (std::uint32_t i = 0; i < times; ++i) {
            push.stride = 1U << i;
            pass(PassId::filter_smooth, programs_.smooth, smooth_[(from + i) % 2]);
        }
        push.stride = 1;
    };
    pass(PassId::filter_guide, programs_.guide, guide_);
    pass(PassId::filter_begin, programs_.begin, begin_);
    smooth(0, kVarianceSmoothings);
    for (std::uint32_t i = 0; spatial_ && i < kLevels; ++i) {
        push.stride = 1U << i;
        pass(PassId::filter_level, i == 0 ? programs_.first_level : programs_.level, level_[i % 2]);
    }
    if (spatial_) {
        pass(PassId::filter_bias, programs_.bias, bias_);
        smooth(1 - kVariances, kBiasSmoothings);
    }
    pass(PassId::filter_end, programs_.end, end_);
}

}  // namespace licht
