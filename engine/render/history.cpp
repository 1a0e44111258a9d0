#include "licht/render/history.h"

namespace licht {
namespace {

gpu::Image storageImage(gpu::Device& device, const char* name, uvec2 size, VkFormat format) {
    return {
        device, name, {size.x, size.y}, format, VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT};
}

}  // namespace

History::History(gpu::Device& device, uvec2 size, bool layers) {
    constexpr VkFormat kFloat4 = VK_FORMAT_R32G32B32A32_SFLOAT;
    gbuffer = gpu::Image(
        device, "gbuffer", {size.x, size.y}, VK_FORMAT_R32G32B32A32_UINT,
        VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    depth = gpu::Image(device, "depth", {size.x, size.y}, VK_FORMAT_D32_SFLOAT,
                       VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
    radiance = storageImage(device, "radiance", size, kFloat4);
    mean_high = storageImage(device, "mean_high", size, kFloat4);
    mean_low = storageImage(device, "mean_low", size, kFloat4);
    squares_high = storageImage(device, "squares_high", size, kFloat4);
    squares_low = storageImage(device, "squares_low", size, kFloat4);
    if (layers) {
        aov_albedo = storageImage(device, "aov_albedo", size, kFloat4);
        aov_normal = storageImage(device, "aov_normal", size, kFloat4);
        aov_motion = storageImage(device, "aov_motion", size, kFloat4);
    }
    display = storageImage(device, "display", size, VK_FORMAT_R8G8B8A8_UNORM);
    nothing = storageImage(device, "nothing", uvec2(1), kFloat4);
}

std::vector<gpu::BoundResource> History::resources() const {
    std::vector<gpu::BoundResource> list{
        {"gbuffer", &gbuffer},           {"radiance_image", &radiance},
        {"mean_high", &mean_high},       {"mean_low", &mean_low},
        {"squares_high", &squares_high}, {"squares_low", &squares_low},
        {"display_image", &display},     {"order_sums", order_sums != nullptr ? order_sums : &nothing},
    };
    if (aov_albedo) {
        list.push_back({"aov_albedo", &aov_albedo});
        list.push_back({"aov_normal", &aov_normal});
        list.push_back({"aov_motion", &aov_motion});
    }
    return list;
}

}  // namespace licht
