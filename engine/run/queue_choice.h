#pragma once
#include <string_view>

#include "licht/run/stop.h"
#include "licht/settings/settings.h"

namespace licht {

/// What of a device decides about queues.
struct QueueDevice {
    bool refills = false;           ///< lanes, where its ballots are right
    std::string_view trouble = {};  ///< Device::ballotTrouble()
};

struct QueueChoice {
    bool queues = false;
    std::string_view trouble = {};  ///< why there are none although they were asked for or would pay
};

/// Whether the paths of such a run go through queues.
QueueChoice chooseQueues(QueueUse use, const RenderSettings& settings, const StopRules& rules,
                         const QueueDevice& device);

/// The deepest paths that may be chosen for a run.
std::uint32_t mostChosenBounces(QueueUse use);

}  // namespace licht
