#include "licht/render/preparation.h"

#include <fmt/format.h>

#include "licht/render/images.h"
#include "licht/shared/effects.h"

namespace licht {

Effects effectsOf(const Scene& scene, const RenderSettings& settings) {
    Effects effects = settings.all_effects ? allEffects() : detectEffects(scene);
    if (settings.flatten_instances) {
        effects.on[kEffectInstances] = false;
        effects.evidence[kEffectInstances].clear();
    }
    return effects;
}

gpu::Device& withRoom(gpu::Device& device, const RenderSettings& settings) {
    device.requireMemory(bytesOfPicture(settings.size, settings),
                         fmt::format("a picture of {}x{} takes", settings.size.x, settings.size.y));
    return device;
}

}  // namespace licht
