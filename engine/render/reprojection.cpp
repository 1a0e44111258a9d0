#include "licht/render/reprojection.h"

#include "licht/spirv/history_fold_comp.h"
#include "licht/spirv/history_reproject_comp.h"

namespace licht {

HistoryPrograms::HistoryPrograms(gpu::Device& device, const gpu::SpecConstants& constants)
    : fold(gpu::Program::compute(device, "history fold", history_fold_comp, constants)),
      reproject(gpu::Program::compute(device, "history reproject", history_reproject_comp, constants)) {}

}  // namespace licht
