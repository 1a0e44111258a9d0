#pragma once
// What earlier views have told, brought to the present one: shaders/history/reproject.glsl names the papers.
#include "licht/gpu/program.h"

namespace licht {

struct HistoryPrograms {
    HistoryPrograms(gpu::Device& device, const gpu::SpecConstants& constants);
    gpu::Program fold;       ///< once the view has changed: from "signal_sums" and "prior" to "history"
    gpu::Program reproject;  ///< behind the new view's first sample: from "history" to "prior"
};

}  // namespace licht
