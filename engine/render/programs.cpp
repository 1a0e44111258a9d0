#include "licht/render/programs.h"

#include "licht/render/gbuffer.h"
#include "licht/spirv/accumulate_comp.h"
#include "licht/spirv/aov_comp.h"
#include "licht/spirv/path_comp.h"
#include "licht/spirv/tonemap_comp.h"

namespace licht {

Programs::Programs(gpu::Device& device, const gpu::SpecConstants& constants, bool with_layers)
    : gbuffer(gbufferProgram(device, constants)),
      path(gpu::Program::compute(device, "path", path_comp, constants)),
      accumulate(gpu::Program::compute(device, "accumulate", accumulate_comp, constants)),
      tonemap(gpu::Program::compute(device, "tonemap", tonemap_comp, constants)) {
    if (with_layers) layers = gpu::Program::compute(device, "layers", aov_comp, constants);
}

}  // namespace licht
