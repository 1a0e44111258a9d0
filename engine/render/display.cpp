#include "licht/render/display.h"

#include <array>
#include <cmath>
#include <span>

#include "licht/film/develop.h"
#include "licht/gpu/upload_image.h"
#include "licht/render/pass_list.h"

namespace licht {

TonemapPush displayedBy(Tonemap curve, float exposure_ev) {
    return {std::exp2(exposure_ev), static_cast<uint>(curve)};
}

void HostPicture::recordDisplay(gpu::Device& device, gpu::Commands& commands, const gpu::Program& tonemap,
                                const Image& picture, const TonemapPush& push, const gpu::Image& display) {
    const VkExtent2D extent{static_cast<std::uint32_t>(picture.width),
                            static_cast<std::uint32_t>(picture.height)};
    mean_ = gpu::uploadImage(device, "picture of the host", extent, VK_FORMAT_R32G32B32A32_SFLOAT,
                             std::as_bytes(std::span(picture.texels)),
                             VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT);
    const std::array<gpu::BoundResource, 2> resources{{{"mean_high", &mean_}, {"display_image", &display}}};
    bindings_ = gpu::Bindings(device, tonemap, resources);
    commands.dispatch(passName(PassId::tonemap), {tonemap, bindings_}, push, {extent.width, extent.height});
}

Image readDisplay(gpu::Device& device, const gpu::Image& display, PassTimes& times,
                  const std::function<void(gpu::Commands&)>& record) {
    gpu::Commands commands(device);
    commands.begin();
    record(commands);
    commands.submit();
    commands.wait();
    addTimes(times, commands.times());
    const VkExtent2D extent = display.extent();
    return developDisplay({extent.width, extent.height}, gpu::readImage(device, display));
}

}  // namespace licht
