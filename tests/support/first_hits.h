#pragma once
// A kernel over what the rasteriser sees.
#include <cstddef>
#include <string>
#include <vector>

#include "licht/gpu/program.h"
#include "licht/scene/scene.h"

namespace licht {

/// Rasterises the scene as its first camera sees it, without alpha, so that rays and rasteriser have the same
/// surfaces and none is there by chance; then runs the kernel on each pixel. Returns the bytes of its buffer
/// OutcomeBlock, which were zero before.
std::vector<std::byte> lookAtFirstHits(const Scene& scene, uvec2 size, const std::string& name,
                                       gpu::Spirv kernel, std::size_t bytes);

}  // namespace licht
