#pragma once
#include "licht/run/stop.h"
#include "licht/settings/settings.h"

namespace licht {

/// Whether the paths of such a run go through queues. `refilled`: the device refills lanes (raysPerThread()).
bool chooseQueues(QueueUse use, const RenderSettings& settings, const StopRules& rules, bool refilled);

}  // namespace licht
