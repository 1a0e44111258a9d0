#pragma once
// What a display shows: the tone map of the renderer's own picture or of one that the host has.
#include <functional>

#include "licht/gpu/commands.h"
#include "licht/image/image.h"
#include "licht/render/statistics.h"
#include "licht/settings/choices.h"
#include "licht/shared/frame.h"

namespace licht {

TonemapPush displayedBy(Tonemap curve, float exposure_ev);

class HostPicture {
public:
    /// RGBA; the device keeps it until the next one, as what is recorded here reads it.
    void recordDisplay(gpu::Device& device, gpu::Commands& commands, const gpu::Program& tonemap,
                       const Image& picture, const TonemapPush& push, const gpu::Image& display);

private:
    gpu::Image mean_;
    gpu::Bindings bindings_;
};

/// Runs what is recorded, and reads what it left in the image: RGBA of [0,1].
Image readDisplay(gpu::Device& device, const gpu::Image& display, PassTimes& times,
                  const std::function<void(gpu::Commands&)>& record);

}  // namespace licht
