#include "licht/run/pilot.h"

#include <algorithm>
#include <cmath>

#include "licht/core/clock.h"
#include "licht/render/renderer.h"

namespace licht {
namespace {

constexpr double kPilotPixels = 2304.0;
constexpr std::uint32_t kDepthSamples = 16;
constexpr std::uint32_t kBiasSamples = 64;
// Deep enough for most scenes; only the others pay for more.
constexpr std::uint32_t kFirstDepth = 32;
// So that the picture's own numbers do not decide how it is made.
constexpr std::uint32_t kPilotSeed = 0x70696c6fU;

RenderSettings pilotSettings(RenderSettings settings) {
    const double scale = std::sqrt(kPilotPixels / (static_cast<double>(settings.size.x) * settings.size.y));
    if (scale < 1.0) {
        settings.size.x = std::max(static_cast<std::uint32_t>(settings.size.x * scale), 1U);
        settings.size.y = std::max(static_cast<std::uint32_t>(settings.size.y * scale), 1U);
    }
    settings.seed ^= kPilotSeed;
    settings.first_sample = 0;
    settings.sampler = Sequence::random;  // independent batches, so that their spread is the error
    settings.clamp = 0.0F;
    settings.orders = true;
    settings.adaptive = false;
    settings.queues = false;
    settings.layers = {};
    return settings;
}

std::vector<LightBatch> render(gpu::Device& device, const Scene& scene, const Camera& camera,
                               const RenderSettings& settings, std::uint32_t samples) {
    Renderer renderer(device, scene, camera, settings);
    for (std::uint32_t i = 0; i < samples; ++i) renderer.renderSample();
    static_cast<void>(renderer.readFilm());
    return renderer.lightBatches();
}

}  // namespace

DepthChoice chooseDepth(gpu::Device& device, const Scene& scene, const Camera& camera,
                        const RenderSettings& settings, double wanted_share, std::uint32_t most) {
    const Clock::time_point start = Clock::now();
    DepthChoice choice;
    choice.wanted_share = wanted_share;
    RenderSettings pilot = pilotSettings(settings);
    for (std::uint32_t depth = std::min(kFirstDepth, most);; depth = most) {
        pilot.bounces = depth;
        pilot.roulette_start = depth;  // what ends by chance is noise just where the tail is sought
        const std::vector<LightBatch> batches = render(device, scene, camera, pilot, kDepthSamples);
        const std::optional<std::uint32_t> found = depthFor(batches, wanted_share);
        choice.pilot_bounces = depth;
        choice.reached = found.has_value();
        choice.bounces = found.value_or(depth);
        choice.tail = estimateTail(batches, choice.bounces);
        if (found || depth == most) break;
    }
    choice.seconds = secondsSince(start);
    return choice;
}

BiasMeasure measureRegularisation(gpu::Device& device, const Scene& scene, const Camera& camera,
                                  const RenderSettings& settings) {
    const Clock::time_point start = Clock::now();
    RenderSettings pilot = pilotSettings(settings);
    pilot.regularise = true;
    const std::vector<LightBatch> biased = render(device, scene, camera, pilot, kBiasSamples);
    pilot.regularise = false;
    const std::vector<LightBatch> unbiased = render(device, scene, camera, pilot, kBiasSamples);
    return {relativeDifference(biased, unbiased), secondsSince(start)};
}

}  // namespace licht
