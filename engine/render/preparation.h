#pragma once
// What a renderer settles before anything of its scene is on the device.
#include "licht/gpu/device.h"
#include "licht/scene/effects.h"
#include "licht/scene/scene.h"
#include "licht/settings/settings.h"

namespace licht {

/// What is compiled: what the scene calls for, or all of it.
Effects effectsOf(const Scene& scene, const RenderSettings& settings);

/// The device where there is memory for a picture of that size, which is said before the scene is brought
/// there. Throws InputError.
gpu::Device& withRoom(gpu::Device& device, const RenderSettings& settings);

}  // namespace licht
