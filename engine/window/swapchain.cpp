#include "licht/window/swapchain.h"

#include <algorithm>

#include "licht/core/error.h"

namespace licht {
namespace {

VkSemaphore makeSemaphore(const gpu::Device& device) {
    VkSemaphoreCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
    VkSemaphore semaphore = VK_NULL_HANDLE;
    gpu::check(vkCreateSemaphore(device.handle(), &info, nullptr, &semaphore), "creating a semaphore");
    return semaphore;
}

/// A layout change of a swapchain image around the copy.
void transition(VkCommandBuffer commands, VkImage image, VkImageLayout from, VkImageLayout to,
                VkAccessFlags2 from_access, VkPipelineStageFlags2 to_stages, VkAccessFlags2 to_access) {
    VkImageMemoryBarrier2 barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
    // The acquisition is waited for at the transfer stages, see Commands::submit.
    barrier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    barrier.srcAccessMask = from_access;
    barrier.dstStageMask = to_stages;
    barrier.dstAccessMask = to_access;
    barrier.oldLayout = from;
    barrier.newLayout = to;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    VkDependencyInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    info.imageMemoryBarrierCount = 1;
    info.pImageMemoryBarriers = &barrier;
    vkCmdPipelineBarrier2(commands, &info);
}

}  // namespace

Swapchain::Swapchain(gpu::Device& device, const Window& window)
    : device_(device), window_(window), frames_{Frame(device), Frame(device)} {
    chooseFormat();
}

Swapchain::Frame::Frame(gpu::Device& device) : commands(device), acquired(makeSemaphore(device)) {}

Swapchain::Frame::~Frame() {
    const gpu::Device& device = commands.device();
    vkDestroySemaphore(device.handle(), device.unlessGivenUp(acquired), nullptr);
}

Swapchain::~Swapchain() {
    if (device_.givenUp()) return;
    vkDeviceWaitIdle(device_.handle());
    destroyTargets();
    vkDestroySwapchainKHR(device_.handle(), swapchain_, nullptr);
}

void Swapchain::chooseFormat() {
    std::uint32_t count = 0;
    gpu::check(
        vkGetPhysicalDeviceSurfaceFormatsKHR(device_.physicalDevice(), device_.surface(), &count, nullptr),
        "listing the surface's formats");
    std::vector<VkSurfaceFormatKHR> formats(count);
    gpu::check(vkGetPhysicalDeviceSurfaceFormatsKHR(device_.physicalDevice(), device_.surface(), &count,
                                                    formats.data()),
               "listing the surface's formats");
    // The source is already encoded, so the surface must not encode again.
    const auto found = std::find_if(formats.begin(), formats.end(), [](const VkSurfaceFormatKHR& format) {
        return format.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR &&
               (format.format == VK_FORMAT_B8G8R8A8_UNORM || format.format == VK_FORMAT_R8G8B8A8_UNORM);
    });
    if (found == formats.end()) {
        throw DeviceError("the display takes no 8-bit UNORM picture");
    }
    format_ = *found;
}

bool Swapchain::recreate() {
    VkSurfaceCapabilitiesKHR surface{};
    gpu::check(
        vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device_.physicalDevice(), device_.surface(), &surface),
        "asking for the surface's size");
    if ((surface.supportedUsageFlags & VK_IMAGE_USAGE_TRANSFER_DST_BIT) == 0) {
        throw DeviceError("the display's images cannot be copied to");
    }
    constexpr std::uint32_t kFreeSize = 0xffffffff;  // the surface takes the swapchain's size
    VkExtent2D extent = surface.currentExtent;
    if (extent.width == kFreeSize) {
        const uvec2 size = window_.framebufferSize();
        extent = {std::clamp(size.x, surface.minImageExtent.width, surface.maxImageExtent.width),
                  std::clamp(size.y, surface.minImageExtent.height, surface.maxImageExtent.height)};
    }
    if (extent.width == 0 || extent.height == 0) {
        return false;
    }
    // One more than the least, so that acquiring need not wait for the display; 0 means that there is no
    // most.
    const std::uint32_t wanted = surface.minImageCount + 1;
    constexpr VkCompositeAlphaFlagBitsKHR kOpaque = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR;

    VkSwapchainCreateInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR;
    info.surface = device_.surface();
    info.minImageCount = surface.maxImageCount == 0 ? wanted : std::min(wanted, surface.maxImageCount);
    info.imageFormat = format_.format;
    info.imageColorSpace = format_.colorSpace;
    info.imageExtent = extent;
    info.imageArrayLayers = 1;
    info.imageUsage = VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    info.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
    info.preTransform = surface.currentTransform;
    info.compositeAlpha =
        (surface.supportedCompositeAlpha & kOpaque) != 0 ? kOpaque : VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
    info.presentMode = VK_PRESENT_MODE_FIFO_KHR;  // no tearing, and every device has it
    info.clipped = VK_TRUE;
    info.oldSwapchain = swapchain_;

    finish();
    device_.waitIdle();
    VkSwapchainKHR next = VK_NULL_HANDLE;
    const VkResult result = vkCreateSwapchainKHR(device_.handle(), &info, nullptr, &next);
    destroyTargets();
    vkDestroySwapchainKHR(device_.handle(), swapchain_, nullptr);
    swapchain_ = next;
    gpu::check(result, "creating the swapchain");
    extent_ = extent;

    std::uint32_t count = 0;
    gpu::check(vkGetSwapchainImagesKHR(device_.handle(), swapchain_, &count, nullptr),
               "listing the swapchain's images");
    std::vector<VkImage> images(count);
    gpu::check(vkGetSwapchainImagesKHR(device_.handle(), swapchain_, &count, images.data()),
               "listing the swapchain's images");
    for (const VkImage image : images) {
        targets_.push_back({image, makeSemaphore(device_)});
    }
    return true;
}

void Swapchain::destroyTargets() noexcept {
    for (const Target& target : targets_) {
        vkDestroySemaphore(device_.handle(), target.rendered, nullptr);
    }
    targets_.clear();
}

bool Swapchain::present(const gpu::Image& source, const std::function<void(gpu::Commands&)>& record) {
    const uvec2 size = window_.framebufferSize();
    if (size.x == 0 || size.y == 0) {
        return false;
    }
    stale_ = stale_ || size.x != extent_.width || size.y != extent_.height;
    if (stale_ && !recreate()) {
        return false;
    }
    stale_ = false;

    Frame& frame = frames_[frame_];
    frame.commands.wait();  // its semaphore is free again
    constexpr std::uint64_t kPatience =
        1'000'000'000;  // nanoseconds; a hidden window may give no image at all
    std::uint32_t index = 0;
    const VkResult acquired = vkAcquireNextImageKHR(device_.handle(), swapchain_, kPatience, frame.acquired,
                                                    VK_NULL_HANDLE, &index);
    if (acquired == VK_TIMEOUT || acquired == VK_NOT_READY || acquired == VK_ERROR_OUT_OF_DATE_KHR) {
        stale_ = acquired == VK_ERROR_OUT_OF_DATE_KHR;
        return false;
    }
    if (acquired != VK_SUBOPTIMAL_KHR) {
        gpu::check(acquired, "acquiring an image of the window");
    }
    const Target& target = targets_[index];

    frame.commands.begin();
    if (record) {
        record(frame.commands);
    }
    frame.commands.pass("present", {{&source, gpu::Access::transfer_read}},
                        [&](VkCommandBuffer recording) { copy(recording, source, target.image); });
    frame.commands.submit(frame.acquired, target.rendered);

    VkPresentInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR;
    info.waitSemaphoreCount = 1;
    info.pWaitSemaphores = &target.rendered;
    info.swapchainCount = 1;
    info.pSwapchains = &swapchain_;
    info.pImageIndices = &index;
    const VkResult presented = vkQueuePresentKHR(device_.queue(), &info);
    stale_ = acquired == VK_SUBOPTIMAL_KHR || presented == VK_SUBOPTIMAL_KHR ||
             presented == VK_ERROR_OUT_OF_DATE_KHR;
    if (!stale_) {
        gpu::check(presented, "presenting");
    }
    frame_ = (frame_ + 1) % frames_.size();
    return true;
}

void Swapchain::copy(VkCommandBuffer commands, const gpu::Image& source, VkImage target) const {
    transition(commands, target, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
               VK_ACCESS_2_NONE, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT);
    const VkExtent2D from = source.extent();
    const auto corner = [](VkExtent2D extent) {
        return VkOffset3D{static_cast<std::int32_t>(extent.width), static_cast<std::int32_t>(extent.height),
                          1};
    };
    VkImageBlit blit{};
    blit.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    blit.srcOffsets[1] = corner(from);
    blit.dstSubresource = blit.srcSubresource;
    blit.dstOffsets[1] = corner(extent_);
    const bool same_size = from.width == extent_.width && from.height == extent_.height;
    vkCmdBlitImage(commands, source.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, target,
                   VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &blit,
                   same_size ? VK_FILTER_NEAREST : VK_FILTER_LINEAR);
    transition(commands, target, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR,
               VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE);
}

void Swapchain::finish() {
    for (Frame& frame : frames_) {
        frame.commands.wait();
    }
}

std::map<std::string, gpu::PassTime> Swapchain::times() const {
    std::map<std::string, gpu::PassTime> sums;
    for (const Frame& frame : frames_) {
        for (const auto& [name, time] : frame.commands.times()) {
            sums[name].seconds += time.seconds;
            sums[name].count += time.count;
        }
    }
    return sums;
}

}  // namespace licht
