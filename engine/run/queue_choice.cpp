#include "licht/run/queue_choice.h"

#include <algorithm>

#include "licht/shared/path.h"

namespace licht {
namespace {

// Queues are drawn from faster, but their programs take longer to compile. After so many vertices (pixels x
// samples x bounces) of an ordinary scene the one has repaid the other; scenes differ by a factor of twenty
// (tests/bench/MEASURED.md, wavefront and megakernel).
constexpr double kRepaidVertices = 16e6;
// The same in seconds of rendering, for the scenes that gain least.
constexpr double kRepaidSeconds = 2.0;
// Absorption and roulette leave few paths that are longer.
constexpr std::uint32_t kUsualBounces = 8;

bool wanted(QueueUse use, const RenderSettings& settings, const StopRules& rules, bool refills) {
    if (use != QueueUse::automatic) return use == QueueUse::on;
    if (!refills || settings.bounces > kMostQueueBounces) return false;
    if (rules.seconds && *rules.seconds < kRepaidSeconds) return false;
    const double vertices = static_cast<double>(settings.size.x) * settings.size.y *
                            std::min(settings.bounces, kUsualBounces) * rules.samples;
    return vertices >= kRepaidVertices;
}

}  // namespace

QueueChoice chooseQueues(QueueUse use, const RenderSettings& settings, const StopRules& rules,
                         const QueueDevice& device) {
    if (!wanted(use, settings, rules, device.refills)) return {};
    return {device.trouble.empty(), device.trouble};
}

std::uint32_t mostChosenBounces(QueueUse use) {
    return use == QueueUse::on ? std::min(kMostQueueBounces, kMostAutoBounces) : kMostAutoBounces;
}

}  // namespace licht
