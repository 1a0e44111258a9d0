#pragma once
#include <array>
#include <functional>
#include <vector>

#include "licht/gpu/commands.h"
#include "licht/window/window.h"

namespace licht {

/// The images of a window, remade whenever its size changes. Both the device and the window outlive it.
class Swapchain {
public:
    /// `device` was made with the options that `window` prepared. Throws DeviceError when the surface takes
    /// no 8-bit UNORM picture.
    Swapchain(gpu::Device& device, const Window& window);
    Swapchain(const Swapchain&) = delete;
    Swapchain& operator=(const Swapchain&) = delete;
    ~Swapchain();

    /// Shows `source`, which is display-referred (already sRGB-encoded) and made with
    /// VK_IMAGE_USAGE_TRANSFER_SRC_BIT; it is scaled when its size differs from the window's. `record`, where
    /// given, records the passes that make the picture, in front of the copy. False when there was nothing to
    /// draw on (minimised, or the window changed its size at that moment); then nothing was recorded.
    bool present(const gpu::Image& source, const std::function<void(gpu::Commands&)>& record = {});

    /// Waits for the frames in flight; call it before an image that was shown is destroyed.
    void finish();

    /// Sums of the passes of all finished frames.
    [[nodiscard]] std::map<std::string, gpu::PassTime> times() const;

private:
    struct Frame {
        explicit Frame(gpu::Device& device);
        Frame(const Frame&) = delete;
        Frame& operator=(const Frame&) = delete;
        ~Frame();
        gpu::Commands commands;
        VkSemaphore acquired = VK_NULL_HANDLE;
    };
    struct Target {
        VkImage image = VK_NULL_HANDLE;
        VkSemaphore rendered =
            VK_NULL_HANDLE;  ///< per image, since presentation holds it until the image comes back
    };

    void chooseFormat();
    bool recreate();
    void destroyTargets() noexcept;
    void copy(VkCommandBuffer commands, const gpu::Image& source, VkImage target) const;

    gpu::Device& device_;
    const Window& window_;
    std::array<Frame, 2> frames_;
    std::size_t frame_ = 0;
    VkSurfaceFormatKHR format_{};
    VkSwapchainKHR swapchain_ = VK_NULL_HANDLE;
    VkExtent2D extent_{};
    std::vector<Target> targets_;
    bool stale_ = true;
};

}  // namespace licht
