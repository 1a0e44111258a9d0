#pragma once
// Small pictures that are rendered before the one that was asked for, to learn something of it.
#include <cstdint>
#include <optional>

#include "licht/film/orders.h"
#include "licht/gpu/device.h"
#include "licht/scene/scene.h"
#include "licht/settings/settings.h"

namespace licht {

struct DepthChoice {
    std::uint32_t bounces = 0;
    double wanted_share = kDefaultTailShare;
    bool reached = false;              ///< false: no depth up to the limit spends the light
    std::optional<TailEstimate> tail;  ///< beyond `bounces`
    std::uint32_t pilot_bounces = 0;   ///< how deep the pilot looked
    double seconds = 0.0;
};

/// The smallest depth at which the orders beyond bring less than `wanted_share` of the light. `settings`: of
/// the picture; `most`: the limit, at most kMostAutoBounces.
DepthChoice chooseDepth(gpu::Device& device, const Scene& scene, const Camera& camera,
                        const RenderSettings& settings, double wanted_share, std::uint32_t most);

/// What a biased shortcut does to the light of a picture: the same samples with it and without.
struct BiasMeasure {
    Estimated change;  ///< of the picture's mean luminance, relative; less than zero: light was taken
    double seconds = 0.0;
};
BiasMeasure measureRegularisation(gpu::Device& device, const Scene& scene, const Camera& camera,
                                  const RenderSettings& settings);

}  // namespace licht
