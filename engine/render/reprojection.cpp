#include "licht/render/reprojection.h"

#include "licht/spirv/history_edges_comp.h"
#include "licht/spirv/history_fold_comp.h"
#include "licht/spirv/history_gradient_comp.h"
#include "licht/spirv/history_parts_comp.h"
#include "licht/spirv/history_reproject_comp.h"
#include "licht/spirv/history_resolve_comp.h"
#include "licht/spirv/history_spread_comp.h"

namespace licht {

HistoryPrograms::HistoryPrograms(gpu::Device& device, const gpu::SpecConstants& constants, bool scene_moves)
    : fold(gpu::Program::compute(device, "history fold", history_fold_comp, constants)),
      reproject(gpu::Program::compute(device, "history reproject", history_reproject_comp, constants)),
      edges(gpu::Program::compute(device, "history edges", history_edges_comp, constants)),
      parts(gpu::Program::compute(device, "history parts", history_parts_comp, constants)),
      resolve(gpu::Program::compute(device, "filter resolve", history_resolve_comp, constants)) {
    if (!scene_moves) return;
    gradient = gpu::Program::compute(device, "history gradient", history_gradient_comp, constants);
    spread = gpu::Program::compute(device, "history spread", history_spread_comp, constants);
}

}  // namespace licht
