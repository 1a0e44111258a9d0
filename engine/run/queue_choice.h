#pragma once
#include "licht/run/stop.h"
#include "licht/settings/settings.h"

namespace licht {

/// Whether the paths of such a run go through queues. `refilled`: the device refills lanes (raysPerThread()).
bool chooseQueues(QueueUse use, const RenderSettings& settings, const StopRules& rules, bool refilled);

/// The deepest paths that may be chosen for a run.
std::uint32_t mostChosenBounces(QueueUse use);

}  // namespace licht
