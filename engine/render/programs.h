#pragma once
#include "licht/gpu/program.h"

namespace licht {

/// Every program of a frame, specialised to what the scene calls for.
struct Programs {
    /// `layers`: compile the program of the extra layers too.
    Programs(gpu::Device& device, const gpu::SpecConstants& constants, bool layers);

    gpu::Program gbuffer, path, accumulate, layers, tonemap;
};

}  // namespace licht
