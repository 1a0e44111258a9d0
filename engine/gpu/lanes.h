#pragma once
#include "licht/gpu/device.h"

namespace licht {

/// Whether a device runs the lanes of a subgroup in lockstep, one by one where they part: a CPU. What
/// programs do about it would cost a GPU.
bool runsInLockstep(const gpu::Device& device);

/// Whether a device says that compute programs have subgroup ballots. Not a core feature; lavapipe and all
/// GPUs of the last ten years have it.
bool offersBallots(const gpu::Device& device);
/// Whether it does, and they are right (Device::ballotTrouble()).
bool hasBallots(const gpu::Device& device);

/// How many rays of a list a thread traces (kConstantRaysPerThread): one, or a share where lanes that are
/// done take the next ray of their subgroup's.
std::uint32_t raysPerThread(const gpu::Device& device);

}  // namespace licht
