#pragma once
// A filter over pixels that show the same surface. The light of two independent halves of the samples is
// filtered, each with the weights of the other; from what both say follow the filter's bias, how much of it
// the picture takes, and the picture's error. shaders/filter/filter.glsl names the papers.
#include <array>

#include "licht/gpu/commands.h"
#include "licht/render/images.h"
#include "licht/shared/signals.h"

namespace licht {

struct FilterPrograms {
    FilterPrograms(gpu::Device& device, const gpu::SpecConstants& constants);
    gpu::Program signals;  ///< once a sample; the others once a picture
    gpu::Program guide, begin, smooth, first_level, level, bias, end;
};

/// How many samples of a picture lie in each half. first_sample: the index of the first one.
struct HalfCounts {
    std::uint32_t a = 0, b = 0;
};
HalfCounts halvesOf(std::uint32_t first_sample, std::uint32_t samples);

/// Of a pass over whole pictures; stride 1.
FilterPush filterPush(uvec2 size, const HalfCounts& counts, bool orthographic);

class SpatialFilter {
public:
    /// All must outlive it.
    /// With denoise temporal it takes noise away only by what earlier views have told. Where a history is
    /// kept it makes "unresolved" and "unresolved_error" instead.
    SpatialFilter(gpu::Device& device, const FilterPrograms& programs, const Images& images,
                  const RenderSettings& settings);

    /// From the images "signal_sums", "prior" and "mean_high" to "filtered" (RGBA) and "filtered_error" (RGB:
    /// estimated squared error; A: of that the squared bias, mean over the channels). `counts`: of the
    /// present view, at least one sample in all.
    void record(gpu::Commands& commands, const HalfCounts& counts, bool orthographic) const;

private:
    const FilterPrograms& programs_;
    uvec2 size_;
    bool spatial_;
    gpu::Bindings guide_, begin_, bias_, end_;
    // From even to odd, and back.
    std::array<gpu::Bindings, 2> smooth_, level_;
};

}  // namespace licht
