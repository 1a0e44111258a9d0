#pragma once
// What earlier views have told, brought to the present one: shaders/history/reproject.glsl names the papers.
#include "licht/gpu/program.h"

namespace licht {

struct HistoryPrograms {
    HistoryPrograms(gpu::Device& device, const gpu::SpecConstants& constants, bool scene_moves);
    gpu::Program fold;       ///< once the view has changed: from "signal_sums" and "prior" to "history"
    gpu::Program reproject;  ///< behind the new view's first sample: from "history" to "prior"
    gpu::Program edges;      ///< likewise: which pixels in "edge_parts" are at edges
    gpu::Program parts;      ///< and what those are drawn from
    gpu::Program gradient;   ///< where the scene moves, before "fold": to "gradients_even"
    gpu::Program spread;     ///< behind it, from one of those images to the other
    gpu::Program resolve;    ///< behind the filter: from "edge_parts" and "unresolved" to "filtered"
};

}  // namespace licht
