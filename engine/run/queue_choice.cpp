#include "licht/run/queue_choice.h"

#include <algorithm>

#include "licht/shared/queue_records.h"

namespace licht {
namespace {

// Measured on lavapipe, CPU seconds over two cores, one kernel against queues: cornell 256x256, 16 samples, 8
// bounces 1.90 and 1.61; gallery 320x180, 3 samples 2.1 and 1.6; terrain 480x270, 8 samples 1.23 and 1.07. So
// a million of vertices (pixels x samples x bounces) saves 0.035, 0.36 and 0.02 of them; compiling queues
// takes 0.35 to 0.5 more, which 14, 1 and 22 million vertices repay.
constexpr double kRepaidVertices = 16e6;
// The same in seconds of rendering, at the least of these gains.
constexpr double kRepaidSeconds = 2.0;
// Absorption and roulette leave few paths that are longer.
constexpr std::uint32_t kUsualBounces = 8;

}  // namespace

bool chooseQueues(QueueUse use, const RenderSettings& settings, const StopRules& rules, bool refilled) {
    if (use != QueueUse::automatic) return use == QueueUse::on;
    if (!refilled || settings.bounces > kMostQueueBounces) return false;
    if (rules.seconds && *rules.seconds < kRepaidSeconds) return false;
    const double vertices = static_cast<double>(settings.size.x) * settings.size.y *
                            std::min(settings.bounces, kUsualBounces) * rules.samples;
    return vertices >= kRepaidVertices;
}

}  // namespace licht
