#include "licht/render/programs.h"

#include <algorithm>

#include "licht/gpu/lanes.h"
#include "licht/render/gbuffer.h"
#include "licht/settings/settings_table.h"
#include "licht/shared/constants.h"
#include "licht/shared/material.h"
#include "licht/spirv/accumulate_comp.h"
#include "licht/spirv/aov_comp.h"
#include "licht/spirv/path_comp.h"
#include "licht/spirv/tonemap_comp.h"

namespace licht {
namespace {

// How many paths a thread follows, one after the other. On a CPU lanes run in lockstep and there are few of
// them: the next path fills a lane whose path has ended. A GPU wants threads. Some drivers end a thread's
// loops after 65,535 rounds. A vertex of a path takes some dozens, and roulette leaves few paths that go on
// for long; half of the rounds are kept in reserve, and a traversal that is truncated all the same is
// reported.
std::uint32_t pathsPerThread(const gpu::Device& device, const RenderSettings& settings) {
    constexpr std::uint32_t kMostPaths = 16;
    constexpr std::uint32_t kRounds = 32'768;
    constexpr std::uint32_t kRoundsPerVertex = 125;
    constexpr std::uint32_t kBouncesInRoulette = 16;
    if (settings.paths_per_thread > 0) return settings.paths_per_thread;
    if (!runsInLockstep(device)) return 1;
    const std::uint32_t roulette = std::min(settings.roulette_start, settings.bounces);
    const std::uint32_t vertices = std::min(settings.bounces, roulette + kBouncesInRoulette) + 1;
    return std::clamp(kRounds / kRoundsPerVertex / vertices, 1U, kMostPaths);
}

}  // namespace

gpu::SpecConstants programConstants(const SceneOnDevice& scene, const RenderSettings& settings) {
    gpu::SpecConstants constants = scene.constants();
    constants.merge(settingConstants(settings));
    constants[kConstantBlueBits] = settings.blue_bits;
    constants[kConstantSignals] = keepsSignals(settings) ? 1U : 0U;
    constants[kConstantReprojects] = keepsHistory(settings) ? 1U : 0U;
    constants[kConstantSceneMoves] = settings.scene_moves ? 1U : 0U;
    constants[kConstantSpatial] = settings.denoise == Denoise::spatiotemporal ? 1U : 0U;
    constants[kConstantOrders] = settings.orders ? settings.bounces + 1U : 0U;
    if (settings.all_effects) {
        constants[kConstantTexturePages] = kTexturePages;
        constants[kConstantTextureSlotKinds] = 0xffffffffU;
        constants[kConstantWideTexels] = 1U;
    }
    return constants;
}

Programs::Programs(gpu::Device& device, const gpu::SpecConstants& constants, const RenderSettings& settings)
    : gbuffer(gbufferProgram(device, constants)),
      paths_per_thread(pathsPerThread(device, settings)),
      accumulate(gpu::Program::compute(device, "accumulate", accumulate_comp, constants)),
      tonemap(gpu::Program::compute(device, "tonemap", tonemap_comp, constants)) {
    if (settings.queues) {
        wavefront.emplace(device, constants, settings.bounces, settings.rays_per_thread);
    } else {
        gpu::SpecConstants with_paths = constants;
        with_paths[kConstantPathsPerThread] = paths_per_thread;
        path = gpu::Program::compute(device, "path", path_comp, with_paths);
    }
    if (keepsSignals(settings)) filter.emplace(device, constants);
    if (keepsHistory(settings)) history.emplace(device, constants, settings.scene_moves);
    if (settings.layers.anyDrawn()) layers = gpu::Program::compute(device, "layers", aov_comp, constants);
}

}  // namespace licht
